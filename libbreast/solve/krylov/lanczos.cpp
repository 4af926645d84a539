// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/krylov/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace breast {

namespace {

// After this many steps, an eigenvector that lies a fifth of the spectrum below the others
// dominates the lowest Ritz vector even if the start contained only 1e-6 of it.
constexpr int least_lanczos_steps = 20;

struct Ritz {
  double value = 0, residual = 0;
};

// The lowest (or highest) Ritz value of a tridiagonal matrix; beside[i] couples i and i + 1, and
// its last entry couples the space with its complement.
Ritz ritz(const Eigen::VectorXd& diagonal, const Eigen::VectorXd& beside, bool highest) {
  const Eigen::Index n = diagonal.size();
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, beside.head(n - 1));
  const Eigen::Index k = highest ? n - 1 : 0;
  return {solver.eigenvalues()[k], std::abs(beside[n - 1] * solver.eigenvectors()(n - 1, k))};
}

}  // namespace

double largest_eigenvalue(const LinearMap& a, const Eigen::VectorXd& start, int steps) {
  Eigen::VectorXd diagonal(steps), beside(steps), last = Eigen::VectorXd::Zero(start.size());
  Eigen::VectorXd v = start / start.norm();
  int done = 0;
  while (done < steps) {
    Eigen::VectorXd w = a(v);
    if (done > 0) w -= beside[done - 1] * last;
    diagonal[done] = w.dot(v);
    w -= diagonal[done] * v;
    beside[done] = w.norm();
    last = std::move(v);
    if (!std::isfinite(beside[done])) return beside[done];
    if (!(beside[done++] > 1e-14 * std::abs(diagonal[0]))) break;  // an invariant space
    v = w / beside[done - 1];
  }
  const Ritz top = ritz(diagonal.head(done), beside.head(done), true);
  return top.value + top.residual;
}

// Lanczos for p a in the inner product of p⁻¹, which needs no p⁻¹ (Paige and Saunders 1975).
LowestEigenvalue lowest_eigenvalue(const LinearMap& a, const LinearMap& p,
                                   const Eigen::VectorXd& start, int most) {
  Eigen::VectorXd diagonal(most), beside(most), before, now = start, moved = p(now);
  double length = std::sqrt(now.dot(moved)), length_before = 1;
  LowestEigenvalue lowest;
  while (lowest.steps < most) {
    const int k = lowest.steps++;
    const Eigen::VectorXd v = moved / length;
    Eigen::VectorXd next = a(v);
    if (k > 0) next -= (length / length_before) * before;
    diagonal[k] = v.dot(next);
    next -= (diagonal[k] / length) * now;
    before = std::move(now);
    now = std::move(next);
    moved = p(now);
    length_before = length;
    const double square = now.dot(moved);
    beside[k] = length = std::sqrt(std::max(0.0, square));
    const Ritz low = ritz(diagonal.head(k + 1), beside.head(k + 1), false);
    lowest.value = low.value;
    lowest.residual = low.residual;
    // Ritz values can only decrease, and an invariant space gives no further information.
    const bool known = low.value < 0 || (lowest.steps >= least_lanczos_steps && lowest.positive());
    if (known || !(length > 1e-14 * std::abs(diagonal[0]))) break;
  }
  if (!std::isfinite(lowest.value) || !std::isfinite(lowest.residual)) lowest = {};
  return lowest;
}

}  // namespace breast
