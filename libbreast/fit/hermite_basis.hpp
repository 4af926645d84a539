// SPDX-License-Identifier: GPL-3.0-or-later
// Weights of the 16 Hermite degrees of freedom of a patch for a point and its derivatives.
#pragma once

#include <array>
#include <vector>

#include "core/types.hpp"
#include "surface/hermite.hpp"

namespace breast {

/// Degrees of freedom per node, in parameter units of one patch: x, S1 x_1, S2 x_2, S1 S2 x_12.
struct PatchWeights {
  int patch_i = 0, patch_j = 0;
  // Entry 4 c + d: corner c (s fastest), degree of freedom d. Derivatives are with respect to (s,t)
  // in [0,1].
  std::array<double, 16> value{}, s{}, t{}, ss{}, st{}, tt{};
};

PatchWeights patch_weights(int nu, int nv, const Vec2& st);

/// Sets the sheet's nodes from its degrees of freedom, node by node (x, and the derivatives by u, v
/// and both in patch coordinates): scale_1 and scale_2 become the mean chord length of the adjacent
/// patches (mm), so that x_1 and x_2 are close to unit vectors.
void set_sheet_dofs(HermiteSheet& sheet, const std::vector<Vec3>& dofs);

/// Second derivatives of a sheet (discontinuous across patches).
struct SheetCurvature {
  Vec3 x_ss, x_st, x_tt;
};
SheetCurvature curvature(const HermiteSheet& sheet, const Vec2& st);

}  // namespace breast
