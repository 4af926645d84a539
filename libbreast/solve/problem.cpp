// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace {

void begin(const Discretisation& space, const State& state, const Request& request) {
  if (request.matrix != nullptr) {
    request.matrix->stiffness.set_zero();
    request.matrix->positions = state.x;
    request.matrix->diagonal.setZero();
  }
  if (request.packed != nullptr) request.packed->begin(space.pressures->elements());
  if (request.reference != nullptr) {
    request.reference->begin();
    request.reference->b_x.resize(space.cells, space.pressures->rows);
    request.reference->b.resize(space.cells, space.pressures->rows);
  }
}

// A node without stiffness of its own still needs a scale for shifts.
void bound_diagonal(SaddleMatrix& matrix) {
  const double floor = 1e-3 * matrix.diagonal.cwiseAbs().mean();
  matrix.diagonal = matrix.diagonal.cwiseMax(floor);
}

}  // namespace

Problem::Problem(std::shared_ptr<const Discretisation> space, Constraints constraints)
    : space_(std::move(space)), constraints_(std::move(constraints)) {}

void Problem::add(std::shared_ptr<const Term> term) {
  terms_.push_back(std::move(term));
}

Forces Problem::evaluate(const State& state, const Request& request) const {
  Forces forces;
  forces.r = Eigen::VectorXd::Zero(3L * nodes());
  forces.theta = Eigen::VectorXd::Zero(space_->pressure_count());
  if (request.kappa != nullptr) forces.augmented = forces.r;
  forces.min_det_F = std::numeric_limits<double>::infinity();
  forces.max_det_F = 0;
  begin(*space_, state, request);
  for (const auto& term : terms_) {
    if (!term->add(state, request, forces)) return forces;
  }
  if (sliding_ && !sliding_->add_curvature(state, request, forces)) return forces;
  if (request.matrix != nullptr) bound_diagonal(*request.matrix);
  forces.valid = true;
  return forces;
}

Forces Problem::forces(const State& state, const Eigen::VectorXd* kappa) const {
  Request request;
  request.kappa = kappa;
  return evaluate(state, request);
}

bool Problem::tangent(const State& state, Forces& forces, SaddleMatrix& matrix) const {
  Request request;
  request.matrix = &matrix;
  forces = evaluate(state, request);
  return forces.valid;
}

Constraints Problem::constraints_at(const Eigen::VectorXd& x) const {
  Constraints all = constraints_;
  if (sliding_ && !sliding_->hold(x, all)) throw failed_error("a node lies beyond the wall surface");
  return all;
}

double Problem::free_norm(const Constraints& held, const Forces& forces) {
  Eigen::VectorXd free = forces.r;
  held.project(free);
  return free.norm();
}

double Problem::volume_residual(const Forces& forces) const {
  const PressureSpace& pressures = *space_->pressures;
  double worst = 0;
  for (long i = 0; i < forces.theta.size(); ++i) {
    const double relative = std::abs(forces.theta[i]) / pressures.volume(int(i / pressures.rows));
    if (std::isnan(relative)) return relative;
    worst = std::max(worst, relative);
  }
  return worst;
}

int Problem::folded_element(const State& state) const {
  for (const auto& term : terms_) {
    const int element = term->folded_element(state);
    if (element >= 0) return element;
  }
  return -1;
}

}  // namespace breast
