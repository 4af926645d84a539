// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/knowledge.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "core/table.hpp"

namespace breast {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double named = 0.4;  // fraction of the largest weight; smaller weights are not mentioned

constexpr double precision = 1e-15;  // of the distribution's series and fraction
constexpr int most_terms = 100000;

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

// x^a e^-x / Γ(a)
double weight(double a, double x) {
  return std::exp(a * std::log(x) - x - std::lgamma(a));
}

// P(a, x) by its series, for x below a + 1.
double lower_by_series(double a, double x) {
  double term = 1 / a, sum = term;
  for (int n = 1; n < most_terms && term > precision * sum; ++n) sum += term *= x / (a + n);
  return sum * weight(a, x);
}

// Q(a, x) by Legendre's continued fraction (Lentz), for x above a + 1.
double upper_by_fraction(double a, double x) {
  double b = x + 1 - a, c = 1e300, d = 1 / b, value = d;
  for (int n = 1; n < most_terms; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    value *= c * d;
    if (std::abs(c * d - 1) < precision) break;
  }
  return value * weight(a, x);
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

double chi_squared_above(double value, double freedom) {
  if (!(value > 0)) return 1;
  const double a = freedom / 2, x = value / 2;
  return x < a + 1 ? 1 - lower_by_series(a, x) : upper_by_fraction(a, x);
}

Misfit misfit_of(const VectorXd& residuals, std::size_t data) {
  Misfit misfit;
  misfit.chi_squared = residuals.squaredNorm();
  misfit.freedom = data;
  misfit.probability = chi_squared_above(misfit.chi_squared, double(data));
  return misfit;
}

}  // namespace breast
