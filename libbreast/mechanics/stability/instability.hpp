// SPDX-License-Identifier: GPL-3.0-or-later
// The cause of an unstable equilibrium: the lowest mode of its tangent, and the terms that
// contribute to it.
#pragma once

#include <string>
#include <vector>

#include "solve/problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// The curvature of the energy along the lowest mode, by term; parts add up to the whole.
struct Instability {
  Eigen::VectorXd mode;  ///< mm, 3 per node, its largest component 1; empty: not known
  double value = 0;      ///< lowest eigenvalue of the tangent relative to its diagonal
  /// Contribution of a term of the problem, or of the wall's curvature where nodes slide, relative
  /// to the sum of the magnitudes of all.
  struct Part {
    std::string name;
    double curvature = 0;
  };
  std::vector<Part> parts;

  /// Share (0 to 1) of the term `name` in the negative curvature of the energy along the mode.
  double share_of(const std::string& name) const;
};

/// The instability of the tangent of `problem` at `state`. `matrix` and `solver` belong to the
/// problem and are overwritten. Empty if no tangent exists.
Instability find_instability(const Problem& problem, const State& state, SaddleMatrix& matrix,
                             SaddleSolver& solver);

}  // namespace breast
