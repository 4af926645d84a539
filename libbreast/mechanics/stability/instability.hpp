// SPDX-License-Identifier: GPL-3.0-or-later
// What makes an equilibrium unstable: the lowest mode of its tangent, and which part of the body
// gives way in it.
#pragma once

#include <string>
#include <vector>

#include "solve/problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// The curvature of the energy along the lowest mode, by term; parts add up to the whole.
struct Instability {
  Eigen::VectorXd mode;  ///< mm, 3 a node, its largest component 1; empty: not known
  double value = 0;      ///< lowest eigenvalue of the tangent relative to its diagonal
  /// Of every term of the problem, and of the wall's curvature where nodes slide; relative to the
  /// sum of the magnitudes of all.
  struct Part {
    std::string name;
    double curvature = 0;
  };
  std::vector<Part> parts;

  /// Of all that lowers the energy along the mode, the share of the term `name`: 0 to 1.
  double share_of(const std::string& name) const;
};

/// Of the tangent of `problem` at `state`. `matrix` and `solver` belong to the problem; both are
/// used anew. Empty where no tangent exists.
Instability find_instability(const Problem& problem, const State& state, SaddleMatrix& matrix,
                             SaddleSolver& solver);

}  // namespace breast
