// SPDX-License-Identifier: GPL-3.0-or-later
// One level of a smoothed-aggregation multigrid: smoother, interpolation, Galerkin product.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "solve/multigrid/aggregates.hpp"
#include "solve/multigrid/block_matrix.hpp"

namespace breast {

/// Near-null space of a level: B × 6 values per node.
template <int B>
using Motions = std::vector<Eigen::Matrix<double, B, 6>>;

template <int B>
struct MultigridLevel {
  BlockMatrix<B, B> a;
  BlockMatrix<B, 6> interpolation;
  Eigen::VectorXd inverse_diagonal;
  double largest = 1;  ///< eigenvalue of D⁻¹A: too low, and the smoother magnifies what is above

  /// False when a diagonal entry is not positive.
  bool prepare();
  /// Applies a Chebyshev polynomial in D⁻¹A to x as initial guess; an empty x counts as zero.
  void smooth(const Eigen::VectorXd& right, Eigen::VectorXd& x) const;
  /// Smoothed interpolation from aggregates; `motions` of this level become those of the next.
  Motions<6> coarsen(const Motions<B>& motions, double threshold);
  BlockMatrix<6, 6> galerkin() const;
};

extern template struct MultigridLevel<3>;
extern template struct MultigridLevel<6>;

}  // namespace breast
