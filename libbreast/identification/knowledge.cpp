// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/knowledge.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "core/table.hpp"
#include "identification/chi_squared.hpp"

namespace breast {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double named = 0.4;  // fraction of the largest weight; smaller weights are not mentioned

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

// 0.08 gives "8 %"; from 0.5 on the deviation is given as a factor.
std::string spread(double deviation) {
  if (deviation < 0.5) return format_fixed(100 * deviation, deviation < 0.02 ? 1 : 0) + " %";
  return "a factor of " + format_fixed(std::exp(deviation), 1) + " either way";
}

std::string subject(const std::vector<std::string>& names, const VectorXd& weights) {
  const double largest = weights.cwiseAbs().maxCoeff();
  std::vector<std::string> with, against;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (std::abs(weights[i]) < named * largest) continue;
    (weights[i] > 0 ? with : against).push_back(names[std::size_t(i)]);
  }
  if (with.empty()) with.swap(against);
  if (!against.empty()) return "the ratio of " + listed(with) + " to " + listed(against);
  return listed(with) + (with.size() > 1 ? " together" : "");
}

}  // namespace

std::string in_words(const std::vector<std::string>& names, const KnownDirection& direction) {
  const std::string what = subject(names, direction.weights);
  const double share = direction.from_data();
  const std::string percent = format_fixed(100 * share, share > 0.99 ? 1 : 0) + " %";
  if (share < 0.5) {
    return what + " not determined by these data: " + spread(direction.deviation) + ", " + percent +
           " of it from the data";
  }
  return what + " known to " + spread(direction.deviation) + ", " + percent +
         " of it from the data";
}

std::vector<KnownDirection> directions_of(const std::vector<std::string>& names,
                                          const MatrixXd& covariance, const MatrixXd& prior) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> found(covariance);
  std::vector<KnownDirection> list;
  for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
    KnownDirection one;
    one.weights = found.eigenvectors().col(k);
    Eigen::Index main = 0;
    one.weights.cwiseAbs().maxCoeff(&main);
    if (one.weights[main] < 0) one.weights *= -1;
    one.deviation = std::sqrt(std::max(found.eigenvalues()[k], 0.0));
    one.prior_deviation = std::sqrt(one.weights.dot(prior * one.weights));
    one.words = in_words(names, one);
    list.push_back(std::move(one));
  }
  return list;
}

double decided_by_data(const MatrixXd& covariance, const MatrixXd& prior) {
  return double(prior.rows()) - prior.ldlt().solve(covariance).trace();
}

VectorXd left_out(const VectorXd& residuals, const MatrixXd& jacobian, const MatrixXd& covariance,
                  const std::vector<Eigen::Index>& rows) {
  const MatrixXd own = jacobian(rows, Eigen::all);
  const Eigen::Index count = Eigen::Index(rows.size());
  const MatrixXd rest = MatrixXd::Identity(count, count) - own * covariance * own.transpose();
  return rest.partialPivLu().solve(VectorXd(residuals(rows)));
}

Misfit misfit_of(const VectorXd& residuals, std::size_t data) {
  Misfit misfit;
  misfit.chi_squared = residuals.squaredNorm();
  misfit.freedom = data;
  misfit.probability = chi_squared_above(misfit.chi_squared, double(data));
  return misfit;
}

}  // namespace breast
