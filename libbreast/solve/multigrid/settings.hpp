// SPDX-License-Identifier: GPL-3.0-or-later
// What our multigrid and PETSc's, which several processes use (distributed), have in common: couplings,
// smoother, and the rigid motions that the coarse spaces keep.
#pragma once

#include <Eigen/Core>

#include "core/types.hpp"
#include "solve/constraints.hpp"

namespace breast {

/// Relative size from which a coupling of nodes is strong: `strong_coupling` on the finest level, and
/// on each other level `coupling_decay` times that of the level before, since couplings thin out as
/// spaces coarsen.
inline constexpr double strong_coupling = 0.02, coupling_decay = 0.5;
/// The smoother is a Chebyshev polynomial in D⁻¹A of this degree, over the spectrum from the part
/// `smoothed_from` of its upper end, which so many steps of Lanczos's method estimate.
inline constexpr int smoother_degree = 3, spectrum_steps = 12;
inline constexpr double smoothed_from = 1.0 / 12;

/// Displacements of a node by three translations and three rotations of the body, one a column. `arm`
/// is the node's place relative to the middle of the body, divided by the body's size. Unless `held` is
/// null, the rows are in its axes, and zero along its held components.
Eigen::Matrix<double, 3, 6> rigid_motion(const Vec3& arm, const NodeConstraint* held);

}  // namespace breast
