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
  Forces forces = evaluate_terms(state, request);
  if (sharing_) agree(request, forces);
  return forces;
}

Forces Problem::evaluate_terms(const State& state, const Request& request) const {
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

// The forces of the whole body from those of this part.
void Problem::agree(const Request& request, Forces& forces) const {
  if (!sharing_->all(forces.valid)) {
    forces.bad_element = sharing_->first_element(forces.valid ? -1 : forces.bad_element);
    forces.valid = false;
    return;
  }
  sharing_->complete(forces.r);
  if (request.kappa != nullptr) sharing_->complete(forces.augmented);
  if (request.matrix != nullptr) sharing_->complete(request.matrix->diagonal);
  forces.energy = sharing_->sum(forces.energy);
  forces.min_det_F = -sharing_->most(-forces.min_det_F);
  forces.max_det_F = sharing_->most(forces.max_det_F);
  forces.max_volume_error = sharing_->most(forces.max_volume_error);
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
  if (sliding_ && !sliding_->hold(x, all))
    throw failed_error("a node lies beyond the wall surface");
  return all;
}

int Problem::restore(Eigen::VectorXd& x) const {
  const int left = sliding_ ? sliding_->restore(x) : -1;
  return all(left < 0) ? -1 : std::max(0, left);
}

double Problem::free_norm(const Constraints& held, const Forces& forces) const {
  Eigen::VectorXd free = forces.r;
  held.project(free);
  return norm(free);
}

double Problem::rounding_force(const SaddleMatrix& matrix, const Eigen::VectorXd& x) const {
  return 8 * std::numeric_limits<double>::epsilon() * norm(matrix.diagonal.cwiseProduct(x));
}

double Problem::volume_residual(const Forces& forces) const {
  const PressureSpace& pressures = *space_->pressures;
  double worst = 0;
  for (long i = 0; i < forces.theta.size() && !std::isnan(worst); ++i) {
    const double relative = std::abs(forces.theta[i]) / pressures.volume(int(i / pressures.rows));
    worst = std::isnan(relative) ? relative : std::max(worst, relative);
  }
  return most(worst);
}

int Problem::folded_element(const State& state) const {
  int folded = -1;
  for (std::size_t i = 0; i < terms_.size() && folded < 0; ++i)
    folded = terms_[i]->folded_element(state);
  return sharing_ ? sharing_->first_element(folded) : folded;
}

}  // namespace breast
