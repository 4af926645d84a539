// SPDX-License-Identifier: GPL-3.0-or-later
// Proof that an element is nowhere folded: Bézier coefficients of its Jacobian determinant.
#pragma once

#include "mesh/topology.hpp"

namespace breast {

/// A lower bound (mm³) of det ∂x/∂ξ over the whole element, not only at points (Johnen, Remacle and
/// Geuzaine, J Comput Phys 233:359, 2013). The determinant is a polynomial of degree 2 (order 1) or
/// 5 (order 2) in each of ξ, η, ζ. Its Bernstein-Bézier coefficients bound it from both sides, and
/// those at the corners are its values there. If the smallest coefficient is not positive, the
/// element is halved in each direction and the parts are tested again, at most four times. A
/// positive result proves that the element is not folded. Otherwise the result is a value of the
/// determinant at a corner of a part, or the last bound.
double jacobian_lower_bound(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element);

}  // namespace breast
