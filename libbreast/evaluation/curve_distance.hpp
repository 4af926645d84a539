// SPDX-License-Identifier: GPL-3.0-or-later
// Distance between two matched curves in the plane of the mammogram.
#pragma once

#include "core/distances.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Distances (mm) between the lines "curve" of `given` and of `truth` for the same query, in both
/// directions, measured in the plane of the detector: displacements along the beam are ignored. The
/// beam is the normal of the plane of truth's lines "curve" and "arc" and its markers in MLO.
/// Throws Error (input) naming `given_name` or `truth_name` if there is no curve for a query, or if
/// truth's points do not span a plane.
struct CurveComparison {
  Distances both;
  int curves = 0;
};
CurveComparison compare_curves(const PolyLines& given, const PolyLines& truth,
                               const std::string& given_name, const std::string& truth_name);

}  // namespace breast
