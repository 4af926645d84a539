// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/trust_region.hpp"

#include <Eigen/Eigenvalues>
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

}  // namespace

TrustRegionResult trust_region(const LeastSquaresProblem& problem, const VectorXd& start,
                               const TrustRegionOptions& options) {
  TrustRegionResult best;
  best.x = start;
  const VectorXd unit = options.unit.size() ? options.unit : VectorXd::Ones(start.size());
  const std::optional<VectorXd> first = problem.residuals(start);
  ++best.evaluations;
  if (!first)
    throw not_converged_error("least squares: the model has no solution at the starting point");
  best.residuals = *first;
  double radius = options.radius;
  while (true) {
    best.jacobian = problem.jacobian();
    ++best.jacobians;
    const Subproblem subproblem(best.jacobian, best.residuals, unit);
    const double now = best.residuals.squaredNorm();
    const auto promised = [&](const VectorXd& d) {
      return now - (best.residuals + best.jacobian * d).squaredNorm();
    };
    if (promised(subproblem.step(HUGE_VAL)) < options.tolerance) {
      best.converged = true;
      best.at_limit = false;
      return best;
    }
    bool moved = false;
    for (int tries = 0; !moved; ++tries) {
      const VectorXd d = subproblem.step(radius);
      const double length = d.cwiseQuotient(unit).norm(), fall = promised(d);
      // Steps this short are no progress: the best point lies at the limit of points with a
      // solution, or the residuals have kinks there (another nearest point of a surface), so that
      // no better point can be found.
      if (tries > 0 && length < shortest) {
        best.converged = !best.at_limit;
        return best;
      }
      if (best.evaluations >= options.max_evaluations) return best;
      const std::optional<VectorXd> found = problem.residuals(best.x + d);
      ++best.evaluations;
      best.at_limit = !found;
      if (!found) best.refused.push_back(best.x + d);
      const double ratio = found ? (now - found->squaredNorm()) / fall : -1;
      if (ratio < 0.25) radius = 0.35 * length;
      if (ratio > 0.75) radius = std::max(radius, 2.5 * length);
      if (!(ratio > 1e-3)) continue;
      best.x += d;
      best.residuals = *found;
      moved = true;
    }
  }
}

}  // namespace breast
