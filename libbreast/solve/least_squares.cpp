// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/least_squares.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double shortest = 5e-3;  // in the parameters' units

// Minimum of |r + J d|² with |d/unit| at most the radius, through the eigenvectors of the scaled JᵀJ.
class Subproblem {
 public:
  Subproblem(const MatrixXd& j, const VectorXd& r, const VectorXd& unit) : unit_(unit) {
    const MatrixXd scaled = j * unit.asDiagonal();
    decomposition_.compute(scaled.transpose() * scaled);
    slope_ = decomposition_.eigenvectors().transpose() * (scaled.transpose() * r);
    values_ = decomposition_.eigenvalues().cwiseMax(0);
  }

  VectorXd step(double radius) const {
    double damping = 0;
    if (!(length(0) <= radius)) {
      // Bounds; at the upper one the step is certainly short enough.
      double low = 0, high = slope_.norm() / radius;
      for (int i = 0; i < 200 && high - low > 1e-12 * high; ++i) {
        damping = 0.5 * (low + high);
        (length(damping) > radius ? low : high) = damping;
      }
      damping = high;
    }
    return unit_.cwiseProduct(decomposition_.eigenvectors() * scaled_step(damping));
  }

 private:
  VectorXd scaled_step(double damping) const {
    return -slope_.cwiseQuotient((values_.array() + damping).matrix());
  }
  double length(double damping) const { return scaled_step(damping).norm(); }

  VectorXd unit_;
  Eigen::SelfAdjointEigenSolver<MatrixXd> decomposition_;
  VectorXd slope_, values_;
};

// The search: where it stands, and the steps it is made of.
class Search {
 public:
  Search(const LeastSquaresProblem& problem, const VectorXd& start,
         const LeastSquaresOptions& options)
      : problem_(problem),
        options_(options),
        unit_(options.unit.size() ? options.unit : VectorXd::Ones(start.size())),
        radius_(options.radius) {
    best_.x = start;
    const std::optional<VectorXd> first = evaluate(start);
    if (!first)
      throw not_converged_error("least squares: the model has no solution at the starting point");
    best_.residuals = *first;
    take_jacobian();
  }

  LeastSquaresResult run() {
    while (true) {
      if (promised(subproblem().step(HUGE_VAL)) < options_.tolerance) {
        if (renewed()) continue;
        best_.converged = true;
        best_.at_limit = false;
        return best_;
      }
      const Outcome outcome = move();
      if (outcome == Outcome::moved) continue;
      if (outcome == Outcome::stuck) {
        if (renewed()) continue;
        best_.converged = !best_.at_limit;
      }
      return best_;
    }
  }

 private:
  enum class Outcome { moved, stuck, out_of_evaluations };

  std::optional<VectorXd> evaluate(const VectorXd& x) {
    ++best_.evaluations;
    return problem_.residuals(x);
  }
  Subproblem subproblem() const { return {best_.jacobian, best_.residuals, unit_}; }
  double promised(const VectorXd& d) const {
    return best_.residuals.squaredNorm() - (best_.residuals + best_.jacobian * d).squaredNorm();
  }

  // Shortens the step until one lowers the sum of squares. Steps shorter than `shortest` are no progress:
  // the best point lies at the limit of points with a solution, or the residuals have kinks there
  // (another nearest point of a surface), so that no better point can be found.
  Outcome move() {
    const bool was_exact = exact_;
    const MatrixXd before = best_.jacobian;
    for (int tries = 0;; ++tries) {
      const VectorXd d = subproblem().step(radius_);
      const double length = d.cwiseQuotient(unit_).norm(), fall = promised(d);
      if (tries > 0 && length < shortest) {
        if (was_exact) best_.jacobian = before, exact_ = true;  // still that of this point
        return Outcome::stuck;
      }
      if (best_.evaluations >= options_.max_evaluations) return Outcome::out_of_evaluations;
      const std::optional<VectorXd> found = evaluate(best_.x + d);
      best_.at_limit = !found;
      if (!found) best_.refused.push_back(best_.x + d);
      const double now = best_.residuals.squaredNorm();
      const double ratio = found ? (now - found->squaredNorm()) / fall : -1;
      if (ratio < 0.25) radius_ = 0.35 * length;
      if (ratio > 0.75) radius_ = std::max(radius_, 2.5 * length);
      if (found && !problem_.jacobian) update_jacobian(d, *found);
      if (!(ratio > 1e-3)) continue;
      best_.x += d;
      best_.residuals = *found;
      if (problem_.jacobian) take_jacobian();
      return Outcome::moved;
    }
  }

  void take_jacobian() {
    best_.jacobian = problem_.jacobian ? problem_.jacobian() : differences();
    ++best_.jacobians;
    exact_ = true;
  }
  // Broyden's update: the smallest change with which the Jacobian explains this evaluation.
  void update_jacobian(const VectorXd& d, const VectorXd& found) {
    const VectorXd surprise = found - best_.residuals - best_.jacobian * d;
    best_.jacobian += surprise * d.transpose() / d.squaredNorm();
    exact_ = false;
  }
  // Takes an updated Jacobian anew, since it may point anywhere; false if it is exact, or if no
  // evaluations are left for it.
  bool renewed() {
    const auto needed = int(best_.x.size());
    if (exact_ || best_.evaluations + needed > options_.max_evaluations) return false;
    take_jacobian();
    radius_ = std::max(radius_, options_.difference);
    return true;
  }

  // Forward quotients; backward ones if the model has no solution ahead.
  MatrixXd differences() {
    MatrixXd jacobian(best_.residuals.size(), best_.x.size());
    for (Eigen::Index k = 0; k < best_.x.size(); ++k) {
      std::optional<VectorXd> moved;
      double h = 0;
      for (const double sign : {1.0, -1.0}) {
        VectorXd x = best_.x;
        h = sign * options_.difference * unit_[k];
        x[k] += h;
        if ((moved = evaluate(x))) break;
      }
      if (!moved)
        throw not_converged_error(
            "least squares: the model has no solution on either side of parameter ", k + 1);
      jacobian.col(k) = (*moved - best_.residuals) / h;
    }
    return jacobian;
  }

  const LeastSquaresProblem& problem_;
  const LeastSquaresOptions& options_;
  VectorXd unit_;
  double radius_;
  LeastSquaresResult best_;
  bool exact_ = false;  ///< the Jacobian is that of the present point, not an updated one
};

}  // namespace

MatrixXd LeastSquaresResult::covariance() const {
  return (jacobian.transpose() * jacobian).ldlt().solve(MatrixXd::Identity(x.size(), x.size()));
}

LeastSquaresResult least_squares(const LeastSquaresProblem& problem, const VectorXd& start,
                                 const LeastSquaresOptions& options) {
  return Search(problem, start, options).run();
}

}  // namespace breast
