// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/smoothing/lbfgs.hpp"

#include <cmath>
#include <deque>

namespace breast {

namespace {

struct Pair {
  Eigen::VectorXd step, change;
  double inverse;  // 1 / step·change
};

// Nocedal & Wright, Numerical Optimization, algorithm 7.4.
Eigen::VectorXd two_loop(const std::deque<Pair>& pairs, const Eigen::VectorXd& gradient) {
  Eigen::VectorXd q = gradient;
  std::vector<double> alpha(pairs.size());
  for (std::size_t i = pairs.size(); i-- > 0;) {
    alpha[i] = pairs[i].inverse * pairs[i].step.dot(q);
    q -= alpha[i] * pairs[i].change;
  }
  if (!pairs.empty()) q /= pairs.back().inverse * pairs.back().change.squaredNorm();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    q += (alpha[i] - pairs[i].inverse * pairs[i].change.dot(q)) * pairs[i].step;
  }
  return -q;
}

}  // namespace

LbfgsResult minimise_lbfgs(
    const std::function<double(const Eigen::VectorXd&, Eigen::VectorXd&)>& energy,
    Eigen::VectorXd& x, const LbfgsOptions& options) {
  LbfgsResult result;
  Eigen::VectorXd gradient(x.size()), trial_gradient(x.size());
  double value = energy(x, gradient);
  result.first = value;
  result.evaluations = 1;
  std::deque<Pair> pairs;
  std::deque<double> recent{value};
  while (result.evaluations < options.evaluations && gradient.squaredNorm() > 0) {
    Eigen::VectorXd direction = two_loop(pairs, gradient);
    if (pairs.empty()) direction *= options.first_step / gradient.cwiseAbs().maxCoeff();
    double slope = direction.dot(gradient);
    if (!(slope < 0)) {  // lost to rounding: restart with steepest descent
      if (pairs.empty()) break;
      pairs.clear();
      continue;
    }
    double length = 1, trial_value = 0;
    Eigen::VectorXd trial;
    bool accepted = false;
    while (!accepted && result.evaluations < options.evaluations && length > 1e-8) {
      trial = x + length * direction;
      trial_value = energy(trial, trial_gradient);
      ++result.evaluations;
      accepted = trial_value <= value + 1e-4 * length * slope;  // false for NaN
      if (!accepted) length *= std::isfinite(trial_value) ? 0.4 : 0.1;
    }
    if (!accepted) {
      if (pairs.empty()) break;
      pairs.clear();
      continue;
    }
    Pair pair{trial - x, trial_gradient - gradient, 0};
    const double curvature = pair.step.dot(pair.change);
    if (curvature > 1e-12 * pair.step.norm() * pair.change.norm()) {
      pair.inverse = 1 / curvature;
      pairs.push_back(std::move(pair));
      if (int(pairs.size()) > options.memory) pairs.pop_front();
    }
    x = trial;
    gradient = trial_gradient;
    value = trial_value;
    ++result.iterations;
    recent.push_back(value);
    if (recent.size() > 10) {
      if (recent.front() - value < options.relative_decrease * std::abs(value)) break;
      recent.pop_front();
    }
  }
  result.last = value;
  return result;
}

}  // namespace breast
