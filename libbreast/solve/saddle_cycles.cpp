// SPDX-License-Identifier: GPL-3.0-or-later
// The saddle system by GMRES with a block triangular preconditioner: a multigrid cycle for
// K + κBᵀM⁻¹B, PressureSchur for the pressure's Schur complement.
#include <cmath>

#include "solve/krylov/gmres.hpp"
#include "solve/krylov/lanczos.hpp"
#include "solve/saddle.hpp"

namespace breast {

SaddleStep SaddleSolver::solve_by_cycles(const SaddleMatrix& matrix, const Eigen::VectorXd& right,
                                         const Eigen::VectorXd& imposed,
                                         const Eigen::VectorXd& theta, double tolerance,
                                         int restarts) const {
  const PressureSpace& space = *matrix.space;
  const ElementRows& b = matrix.divergence;
  const long n = right.size(), m = theta.size();
  const double left_over = 1 - matrix.kappa[0] * space.compliance[0];
  // Volumes converted to forces, θκ/h with the size h of an element, so that one norm measures both
  // equations.
  const double size = std::cbrt(space.mass[0]);
  const double weigh = matrix.kappa.mean() / size;
  const auto free = [&](Eigen::VectorXd v) {
    constraints_.project(v);
    return v;
  };
  const auto stiffness = [&](Eigen::VectorXd v) {  // of the shifted matrix, on the free part
    constraints_.to_axes(v);
    v = multigrid_.multiply(v);
    constraints_.from_axes(v);
    return free(std::move(v));
  };
  const auto apply = [&](const Eigen::VectorXd& z) {
    const Eigen::VectorXd u = z.head(n), p = z.tail(m);
    Eigen::VectorXd out(n + m);
    out.head(n) = stiffness(u) - left_over * free(b.apply_transpose(p));
    out.tail(m) = weigh * (b.apply(u) + space.multiply(p, space.compliance));
    return out;
  };
  const auto precondition = [&](const Eigen::VectorXd& y) {
    Eigen::VectorXd out(n + m);
    const Eigen::VectorXd u = back_solve(y.head(n));
    out.head(n) = u;
    out.tail(m) = schur_.solve(y.tail(m) / weigh - b.apply(u));
    return out;
  };
  Eigen::VectorXd target(n + m), x = Eigen::VectorXd::Zero(n + m);
  target.head(n) = free(right);
  target.tail(m) = -weigh * (imposed.size() > 0 ? theta + b.apply(imposed) : theta);
  const double goal = gmres_part_of_tolerance * tolerance * target.norm();
  SaddleStep step;
  Eigen::VectorXd residual = target;
  for (int i = 0; i < restarts && residual.norm() > goal; ++i) {
    const GmresResult part =
        gmres(apply, precondition, residual, goal / residual.norm(), gmres_restart);
    x += part.x;
    step.iterations += part.iterations;
    step.solved = part.converged;
    residual = target - apply(x);
  }
  step.u = x.head(n);
  step.p = x.tail(m);
  if (imposed.size() > 0) step.u += imposed;
  return step;
}

bool SaddleSolver::positive_definite() const {
  if (cholesky_ != nullptr || !definite_) return definite_;
  Eigen::VectorXd start(3L * constraints_.nodes());  // a vector that is not an eigenvector
  for (long i = 0; i < start.size(); ++i) start[i] = std::sin(2.0 + 5.1 * double(i));
  return lowest_eigenvalue([&](const Eigen::VectorXd& v) { return multigrid_.multiply(v); },
                           [&](const Eigen::VectorXd& v) { return multigrid_.cycle(v); }, start,
                           most_definite_steps)
      .positive();
}

}  // namespace breast
