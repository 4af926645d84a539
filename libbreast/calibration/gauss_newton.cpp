// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/gauss_newton.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Iteration {
 public:
  Iteration(const Residuals& residuals, VectorXd start, const GaussNewtonOptions& options)
      : residuals_(residuals), options_(options) {
    best_.x = std::move(start);
    const std::optional<VectorXd> first = at(best_.x);
    if (!first)
      throw not_converged_error("least squares: the model has no solution at the starting point");
    best_.residuals = *first;
    take_differences();
  }

  LeastSquares run() {
    for (int i = 0; i < options_.max_iterations && !best_.converged; ++i) step();
    if (!exact_) take_differences();
    best_.covariance = (best_.jacobian.transpose() * best_.jacobian)
                           .ldlt()
                           .solve(MatrixXd::Identity(best_.x.size(), best_.x.size()));
    return best_;
  }

 private:
  std::optional<VectorXd> at(const VectorXd& x) {
    ++best_.evaluations;
    return residuals_(x);
  }

  // Forward quotients; backward ones if the model has no solution ahead.
  MatrixXd differences() {
    MatrixXd jacobian(best_.residuals.size(), best_.x.size());
    for (Eigen::Index k = 0; k < best_.x.size(); ++k) {
      std::optional<VectorXd> moved;
      double h = options_.difference;
      for (const double sign : {1.0, -1.0}) {
        VectorXd x = best_.x;
        x[k] += h = sign * options_.difference;
        if ((moved = at(x))) break;
      }
      if (!moved)
        throw not_converged_error(
            "least squares: the model has no solution on either side of parameter ", k + 1);
      jacobian.col(k) = (*moved - best_.residuals) / h;
    }
    return jacobian;
  }

  void take_differences() {
    best_.jacobian = differences();
    exact_ = true;
  }

  // A small step, or one that leads nowhere, is the end only if the Jacobian is one of differences:
  // after a few of Broyden's updates it may point anywhere.
  void step() {
    const MatrixXd& j = best_.jacobian;
    VectorXd d = -(j.transpose() * j).ldlt().solve(j.transpose() * best_.residuals);
    const bool was_exact = exact_, small = d.cwiseAbs().maxCoeff() < options_.tolerance;
    if (small) {
      if (was_exact)
        best_.converged = true;
      else
        take_differences();
      return;
    }
    const MatrixXd before = best_.jacobian;
    d *= std::min(1.0, options_.largest_step / d.cwiseAbs().maxCoeff());
    for (int halvings = 0; halvings < 5; ++halvings, d *= 0.5) {
      const std::optional<VectorXd> found = at(best_.x + d);
      if (!found) continue;
      const VectorXd surprise = *found - best_.residuals - best_.jacobian * d;
      best_.jacobian += surprise * d.transpose() / d.squaredNorm();  // Broyden's update
      exact_ = false;
      if (found->squaredNorm() < best_.residuals.squaredNorm()) {
        best_.x += d;
        best_.residuals = *found;
        return;
      }
    }
    if (!was_exact) return take_differences();
    best_.jacobian = before;  // of differences at this point, which need not be computed again
    exact_ = true;
    best_.converged = d.cwiseAbs().maxCoeff() < options_.tolerance;
  }

  const Residuals& residuals_;
  GaussNewtonOptions options_;
  LeastSquares best_;
  bool exact_ = false;  ///< the Jacobian is that of differences at the present point
};

}  // namespace

LeastSquares gauss_newton(const Residuals& residuals, VectorXd start,
                          const GaussNewtonOptions& options) {
  return Iteration(residuals, std::move(start), options).run();
}

}  // namespace breast
