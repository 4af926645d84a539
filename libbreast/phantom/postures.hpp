// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanics of the phantom: the prone and supine shapes of its known stress-free shape.
#pragma once

#include "mechanics/mechanics.hpp"
#include "phantom/scene.hpp"

namespace breast {

/// Equilibria of one breast. The mesh given to solve_postures becomes prone: imaged = points.
struct Postures {
  std::vector<Vec3> stress_free, supine;  ///< nodal positions
  std::vector<double> pressure;           ///< Pa per element, of the prone shape
  SolveSummary prone, supine_solve;
  ModelText model;  ///< with which both were solved
  /// Distance in mm between the shape `imaged` used for the load and the solution `points`.
  double imaged_gap = 0;
};

/// Solves a breast with fixed wall and cut. As everywhere in the chain, gravity forces and skin
/// thickness are those of the imaged (prone) shape; the prone shape is therefore solved repeatedly
/// with the forces of its own result until they agree to 1e-4 mm (`imaged_gap`). mesh.imaged is the
/// initial guess of the prone shape. Throws Error (not converged) naming the side and the posture.
Postures solve_postures(HexMesh& mesh, const MaterialSet& materials,
                        Progress& progress = no_progress());

/// The same for a breast that is defined by its prone shape and slides on `surface` (null: on the
/// chest-wall surface of the mesh's geometry): prone is mesh.imaged, and the stress-free shape comes
/// from the backward solve. The materials include the supports of wall and cut.
Postures solve_sliding_postures(const HexMesh& mesh, const MaterialSet& materials,
                                std::shared_ptr<const LevelSurface> surface,
                                Progress& progress = no_progress());

/// Gives `to` the landmarks of `from`: the same points of the stress-free body. Both meshes need
/// `reference`. The nipple is sought on the skin.
void carry_landmarks(const HexMesh& from, HexMesh& to);

/// Largest distance (mm) of any landmark from its position on a mesh of half the resolution: the
/// error stated for the truth.
struct TruthError {
  double prone_mm = 0, supine_mm = 0;
  int elements = 0;  ///< number of elements of the coarser mesh
  double worst() const { return prone_mm > supine_mm ? prone_mm : supine_mm; }
};

/// Solves the breast, held or sliding, on a mesh of half the resolution and on its own, and compares.
/// A sliding breast slides on the wall surface of the mesh's geometry if there is one, otherwise on
/// RibSurface.
Postures solve_breast(PhantomBreast& breast, const PhantomParameters& parameters,
                      const MaterialSet& materials, TruthError& error,
                      Progress& progress = no_progress());

}  // namespace breast
