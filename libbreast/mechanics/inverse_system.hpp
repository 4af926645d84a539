// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method for the inverse problem: the stress-free shape X and the pressures for which a
// given shape x is in equilibrium. The directions come from GMRES with the exact derivatives with
// respect to X; a factor of the forward tangent is only the preconditioner, so that one factor
// serves several steps.
#pragma once

#include <functional>

#include "core/report.hpp"
#include "mechanics/reference_system.hpp"
#include "solve/newton.hpp"
#include "solve/problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// Residual of the forces, relative to the load, at which a solve ends.
inline constexpr double inverse_tolerance = 1e-10;

/// Solves the system of mechanics/reference_system.hpp for (f, v), preconditioned by the last factor of
/// `matrix`, with the constraints `moved` of δX.
using SolveReference = std::function<ReferenceStep(
    const SaddleMatrix& matrix, const ReferenceTangent& tangent, const Constraints& moved,
    const Eigen::VectorXd& f, const Eigen::VectorXd& v, double tolerance, int max_iterations)>;
/// That for a body in one piece; `solver` must outlive it.
SolveReference solve_reference_by(const SaddleSolver& solver);

class InverseSolver {
 public:
  /// With `fail_fast` a solve gives up at the first difficulty. All references must outlive this;
  /// the problem's load may change between solves. `solve_reference` uses the factors of `solver`.
  InverseSolver(const Problem& problem, SaddleSolverBase& solver, SolveReference solve_reference,
                bool fail_fast, Timer& timer);

  /// Moves state.reference and state.p until the residual of the forces is `tolerance` of the load, and that of the
  /// volumes a tenth of it; if it does not converge, to the last admissible ones.
  NewtonResult solve(State& state, double tolerance,
                     const std::function<void(const NewtonIteration&)>& watch);
  /// Whether the forward tangent at the state is known to be positive definite; `augmentation` is
  /// κ/μ, where 0 chooses what suits the linear solver.
  bool stable(const State& state, double augmentation);

  /// The matrix, as workspace for another factor of `solver`.
  SaddleMatrix& lend_matrix() {
    last_gmres_ = max_gmres;
    return matrix_;
  }
  const SaddleMatrix& matrix() const { return matrix_; }
  /// Smallest det F of the last state evaluated.
  double min_det_F() const { return min_det_F_; }

 private:
  class System;
  static constexpr int max_gmres = 60;

  const Problem& problem_;
  SaddleSolverBase& solver_;
  SolveReference solve_reference_;
  bool fail_fast_;
  Timer& timer_;
  SaddleMatrix matrix_;
  ReferenceTangent tangent_;
  double min_det_F_ = 1;
  int last_gmres_ = max_gmres;  // iterations with the present factor; none yet
};

}  // namespace breast
