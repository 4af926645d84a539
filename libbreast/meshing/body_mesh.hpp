// SPDX-License-Identifier: GPL-3.0-or-later
// Hexahedral meshing of the body of a geometry: template, placement, smoothing, skin layer, checks.
#pragma once

#include <string>

#include "meshing/boundary_distance.hpp"
#include "meshing/curve_boundary.hpp"
#include "meshing/dome.hpp"
#include "meshing/smooth.hpp"

namespace breast {

struct BodyMeshOptions {
  DomeSize size = {};     ///< m = 0: cuboid
  int order = 1;          ///< 2: 27-node elements whose boundary nodes lie on the surfaces
  double skin_layer = 0;  ///< thickness of the outermost layer of elements in mm, if > 0
  SmoothOptions smoothing = {};
};

struct BodyMeshReport {
  /// Meshes that were tried, and the step with which the mesh was found (attempts.hpp); empty for the
  /// mesh that was asked for, whose worst scaled Jacobian is `asked_scaled_jacobian`.
  int attempts = 0;
  std::string step;
  double asked_scaled_jacobian = 0;
  double placed_scaled_jacobian = 0;    ///< minimum scaled Jacobian before smoothing
  double smoothed_scaled_jacobian = 0;  ///< minimum scaled Jacobian after smoothing
  int evaluations = 0;
  double body_volume = 0;  ///< mm³ inside the sheets, cut and wall
  double mesh_volume = 0;  ///< mm³
  double skin_shift = 0;   ///< mm, largest shift of a skin node off its sheet to keep the volume
  CurveReport curved;      ///< order 2 only
  Distances skin_distance, wall_distance, cut_distance;  ///< distances of the mesh's boundary
};

/// Returns a mesh in its imaged shape with connectivity, face sets, scaled_jacobian, template and
/// geometry. All elements are fat, except those of a skin layer. Where the mesh that was asked for has
/// a badly shaped element, others are tried in the order of attempts.hpp, until one is well shaped;
/// otherwise the best of them is returned. Throws Error (input) if an element of that is folded,
/// stating its position, or if the geometry's rim or orientation is unusable.
HexMesh body_mesh(const BreastGeometry& geometry, const BodyMeshOptions& options,
                  BodyMeshReport* report = nullptr);

}  // namespace breast
