// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/saddle.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace breast {

namespace {

constexpr double first_shift = 1e-5, shift_growth = 8, largest_shift = 10;
constexpr int max_pressure_iterations = 60;

}  // namespace

SaddleSolver::SaddleSolver(const std::shared_ptr<const NodePattern>& pattern, LinearSolver kind)
    : SaddleSolverBase(pattern->nodes()), kind_(kind), work_(pattern) {
  if (kind == LinearSolver::direct) cholesky_ = std::make_unique<Cholesky>(*pattern);
}

double SaddleSolver::factor_entries() const {
  if (cholesky_ != nullptr) return cholesky_->factor_entries();
  return factorisations_ == 0
             ? 0
             : 2 * double(work_.values().size()) * multigrid_.complexity() + schur_.entries();
}
double SaddleSolver::factor_gflop() const {
  return cholesky_ != nullptr ? cholesky_->factor_gflop() : 0;
}

// Rotates the blocks of constrained nodes into their axes, then replaces held rows and columns by a
// multiple of the identity of ordinary size.
void SaddleSolver::impose(const SaddleMatrix& matrix) {
  const NodePattern& pattern = work_.pattern();
  work_.values() = matrix.stiffness.values();
  const double scale = std::max(matrix.diagonal.mean(), 1e-300);
#pragma omp parallel for num_threads(threads()) \
    schedule(dynamic, 128) if (pattern.nodes() > worth_threads)
  for (int column = 0; column < pattern.nodes(); ++column) {
    const NodeConstraint* right = constraints_.at(column);
    for (int slot = -1; slot < pattern.rows_count(column); ++slot) {
      const int row = slot < 0 ? column : pattern.rows_begin(column)[slot];
      const NodeConstraint* left = constraints_.at(row);
      if (left == nullptr && right == nullptr) continue;
      Mat3 block = work_.block(column, slot);
      if (left != nullptr) block = left->axes.transpose() * block;
      if (right != nullptr) block = block * right->axes;
      for (int i = 0; i < 3; ++i) {
        if (left != nullptr && left->held[i]) block.row(i).setZero();
        if (right != nullptr && right->held[i]) block.col(i).setZero();
      }
      if (slot < 0) {
        for (int i = 0; i < 3; ++i) {
          if (right->held[i]) block(i, i) = scale;
        }
      }
      work_.set_block(column, slot, block);
    }
  }
}

Factorisation SaddleSolver::factorise(const SaddleMatrix& matrix, const Constraints& constraints,
                                      bool may_shift) {
  constraints_ = constraints;
  impose(matrix);
  Factorisation result;
  const NodePattern& pattern = work_.pattern();
  double shift = 0, added = 0;
  while (true) {
    for (int node = 0; node < pattern.nodes() && shift > added; ++node) {
      const double size = (shift - added) * matrix.diagonal.segment<3>(3L * node).mean();
      work_.add_to_node(node, size * Mat3::Identity());
    }
    added = shift;
    ++factorisations_;
    ++result.attempts;
    result.ok = cholesky_ != nullptr ? cholesky_->factorise(work_.values())
                                     : multigrid_.build(work_, constraints_, matrix.positions) &&
                                           schur_.build(matrix, work_, constraints_);
    result.shift = shift;
    if (result.ok || !may_shift) break;
    shift = shift > 0 ? shift * shift_growth : std::max(first_shift, last_shift_ / shift_growth);
    if (!(shift <= largest_shift)) break;
  }
  // The next tangent that is not definite is likely to need a similar shift, even if definite ones lie between.
  if (result.ok && shift > 0) last_shift_ = shift;
  definite_ = result.ok && result.shift == 0;
  return result;
}

Eigen::VectorXd SaddleSolver::back_solve(const Eigen::VectorXd& v) const {
  Eigen::VectorXd local = v;
  constraints_.project(local);
  constraints_.to_axes(local);
  Eigen::VectorXd u = cholesky_ != nullptr ? cholesky_->solve(local) : multigrid_.cycle(local);
  constraints_.from_axes(u);
  constraints_.project(u);
  return u;
}

Eigen::VectorXd SaddleSolver::schur_solve(const SaddleMatrix& matrix,
                                          const Eigen::VectorXd& q) const {
  return cholesky_ != nullptr ? matrix.space->divide(q, matrix.kappa) : schur_.solve(q);
}

SaddleStep SaddleSolverBase::solve(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                                   const Eigen::VectorXd& theta, double tolerance,
                                   int restarts) const {
  Eigen::VectorXd imposed;
  if (constraints_.any_increment()) imposed = constraints_.increments();
  return solve_imposed(matrix, r, theta, imposed, tolerance, restarts);
}

Eigen::VectorXd SaddleSolverBase::correction(const SaddleMatrix& matrix,
                                             const Eigen::VectorXd& imposed,
                                             const Eigen::VectorXd& theta, double tolerance) const {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(imposed.size());
  return solve_imposed(matrix, none, theta, imposed, tolerance, gmres_restarts).u;
}

SaddleStep SaddleSolver::solve_imposed(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                                       const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed,
                                       double tolerance, int restarts) const {
  const PressureSpace& space = *matrix.space;
  const ElementRows& b = matrix.divergence;
  Eigen::VectorXd right = -r - b.apply_transpose(space.divide(theta, matrix.kappa));
  if (imposed.size() > 0) right -= matrix.stiffness.multiply(imposed);
  return cholesky_ != nullptr ? solve_by_factor(matrix, right, imposed, theta, tolerance)
                              : solve_by_cycles(matrix, right, imposed, theta, tolerance, restarts);
}

// Conjugate gradients on S = (1 − κc) B K_κ⁻¹ Bᵀ + cM, preconditioned by κ M⁻¹; κc is the same in
// every element, so that S is symmetric.
SaddleStep SaddleSolver::solve_by_factor(const SaddleMatrix& matrix, const Eigen::VectorXd& right,
                                         const Eigen::VectorXd& imposed,
                                         const Eigen::VectorXd& theta, double tolerance) const {
  const PressureSpace& space = *matrix.space;
  const ElementRows& b = matrix.divergence;
  SaddleStep step;
  step.u = back_solve(right);
  if (imposed.size() > 0) step.u += imposed;

  const double left_over = 1 - matrix.kappa[0] * space.compliance[0];
  step.p = Eigen::VectorXd::Zero(theta.size());
  Eigen::VectorXd s = -theta - b.apply(step.u);
  Eigen::VectorXd z = space.divide(s, matrix.kappa), d = z;
  double sz = s.dot(z);
  const double target = tolerance * tolerance * sz;
  while (sz > target && step.iterations < max_pressure_iterations) {
    Eigen::VectorXd sd = space.multiply(d, space.compliance);
    Eigen::VectorXd w;
    if (left_over > 1e-12) {
      w = left_over * back_solve(b.apply_transpose(d));
      sd += b.apply(w);
    }
    const double curvature = d.dot(sd);
    if (!(curvature > 0)) break;
    const double alpha = sz / curvature;
    step.p += alpha * d;
    if (w.size() > 0) step.u += alpha * w;
    s -= alpha * sd;
    z = space.divide(s, matrix.kappa);
    const double next = s.dot(z);
    d = z + (next / sz) * d;
    sz = next;
    ++step.iterations;
  }
  return step;
}

}  // namespace breast
