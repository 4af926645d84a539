// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/stability/instability.hpp"

#include <cmath>

#include "solve/krylov/lowest_mode.hpp"

namespace breast {

namespace {

constexpr double mode_accuracy = 1e-4;
constexpr int most_steps = 60;
// Step in mm along a mode with a largest component of 1: the error of central differences is
// proportional to its square, and that of rounding to its inverse.
constexpr double difference = 1e-3;

// vᵀ(∂r/∂x)v of one term, by central differences of its forces.
double curvature_of(const Term& term, const State& state, const Eigen::VectorXd& mode) {
  double sum = 0;
  for (const double side : {difference, -difference}) {
    State there = state;
    there.x += side * mode;
    Forces forces;
    forces.r = Eigen::VectorXd::Zero(state.x.size());
    forces.theta = Eigen::VectorXd::Zero(state.p.size());
    if (!term.add(there, {}, forces)) return 0;
    sum += mode.dot(forces.r) / (2 * side);
  }
  return sum;
}

}  // namespace

double Instability::share_of(const std::string& name) const {
  double lowering = 0, own = 0;
  for (const Part& part : parts) {
    lowering += std::min(0.0, part.curvature);
    if (part.name == name) own += std::min(0.0, part.curvature);
  }
  return lowering < 0 ? own / lowering : 0;
}

Instability find_instability(const Problem& problem, const State& state, SaddleMatrix& matrix,
                             SaddleSolver& solver) {
  Instability found;
  Forces forces;
  if (!problem.tangent(state, forces, matrix)) return found;
  const Constraints held = problem.constraints_at(state.x);
  if (!solver.factorise(matrix, held).ok) return found;
  const auto tangent = [&](const Eigen::VectorXd& v) {
    Eigen::VectorXd out = matrix.stiffness.multiply(v);
    held.project(out);
    return out;
  };
  Eigen::VectorXd weight(state.x.size()), start(state.x.size());
  for (long node = 0; node < weight.size() / 3; ++node) {
    weight.segment<3>(3 * node).setConstant(matrix.diagonal.segment<3>(3 * node).mean());
  }
  for (long i = 0; i < start.size(); ++i) start[i] = std::sin(2.0 + 5.1 * double(i));
  const LowestMode lowest = lowest_mode(
      tangent, [&](const Eigen::VectorXd& v) { return solver.back_solve(v); }, weight,
      solver.back_solve(start), mode_accuracy, most_steps);
  found.value = lowest.value;
  if (lowest.mode.size() == 0 || !lowest.mode.allFinite()) return found;
  found.mode = lowest.mode / lowest.mode.lpNorm<Eigen::Infinity>();

  double magnitude = 0, sum = 0;
  const auto note = [&](const std::string& name, double curvature) {
    found.parts.push_back({name, curvature});
    magnitude += std::abs(curvature);
    sum += curvature;
  };
  for (const auto& term : problem.terms()) {
    note(term->name(), curvature_of(*term, state, found.mode));
  }
  if (problem.sliding() != nullptr) {
    note("wall curvature", found.mode.dot(matrix.multiply_unaugmented(found.mode)) - sum);
  }
  if (magnitude > 0) {
    for (Instability::Part& part : found.parts) part.curvature /= magnitude;
  }
  return found;
}

}  // namespace breast
