// The physics of the phantom: from the known stress-free shape to the prone and the supine one.
#pragma once

#include "mechanics/mechanics.hpp"
#include "phantom/scene.hpp"

namespace breast {

/// Equilibria of one breast. The mesh given to solve_postures becomes prone: imaged = points.
struct Postures {
  std::vector<Vec3> supine;  ///< nodal positions
  SolveSummary prone, supine_solve;
  double imaged_gap = 0;  ///< mm between `imaged` as loaded and `points` as solved
};

/// Wall and cut held. Gravity forces and skin thickness belong to the imaged (prone) shape, as
/// everywhere in the chain, so prone is solved again with the forces of its own result until they
/// agree to 1e-6 mm. Throws Error (not converged) naming the side and the posture.
Postures solve_postures(HexMesh& mesh, const MaterialSet& materials,
                        Progress& progress = no_progress());

/// The same breast on a mesh of half the resolution: the largest distance (mm) of any landmark's
/// prone and supine positions to those of `fine` is the error stated for the truth.
struct TruthError {
  double prone_mm = 0, supine_mm = 0;
  int elements = 0;
  double worst() const { return prone_mm > supine_mm ? prone_mm : supine_mm; }
};
TruthError truth_error(const PhantomBreast& breast, const Postures& fine,
                       const PhantomParameters& parameters, const MaterialSet& materials,
                       Progress& progress = no_progress());

}  // namespace breast
