// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/waypoint.hpp"

#include <algorithm>

#include "core/units.hpp"

namespace breast {

namespace {

/// Number of states kept before the last two.
constexpr std::size_t longest_trail = 3;

/// Moves the bounds by `ratio` times their last change.
void extrapolate_bounds(const ContactMemory& before, double ratio, ContactMemory& memory) {
  if (before.bounds.size() != memory.bounds.size()) return;
  for (std::size_t c = 0; c < memory.bounds.size(); ++c) {
    const bool stays = memory.touching[c] >= 0 && memory.touching[c] == before.touching[c];
    const double change = memory.bounds[c] - before.bounds[c];
    if (stays) memory.bounds[c] = std::max(0.0, memory.bounds[c] + ratio * change);
  }
}

}  // namespace

PathPoint path_point(const ContactSolver& solver, const PlatePair& plates, const State& state,
                     const ContactStep& step, double paddle_area) {
  PathPoint point;
  point.thickness = plates.thickness();
  point.iterations = int(step.iterations.size());
  for (std::size_t c = 0; c < step.contacts.size(); ++c) {
    const NodalContact& contact = step.contacts[c];
    if (contact.plate < 0) continue;
    const Vec3 x = state.x.segment<3>(3L * solver.candidates()[c]);
    const Plate& plate = plates.plate(contact.plate);
    const double along =
        (contact.normal * plate.gap(x).gradient + contact.tangential).dot(plate.normal());
    (contact.plate == 0 ? point.paddle_N : point.detector_N) += along / micronewton_per_newton;
  }
  for (const PressedPoint& pressed : step.pressed) {
    const Plate& plate = plates.plate(pressed.plate);
    if (!(plate.in_front(pressed.at) < 0)) continue;
    const double along = pressed.force.dot(plate.normal()) / micronewton_per_newton;
    (pressed.plate == 0 ? point.paddle_edge_N : point.detector_edge_N) += along;
  }
  point.area_cm2 = paddle_area / mm2_per_cm2;
  if (paddle_area > 0) {
    point.pressure_kPa =
        point.paddle_N * micronewton_per_newton / paddle_area / pascal_per_kilopascal;
  }
  return point;
}

Guess interpolate(const Waypoint& before, const Waypoint& beyond, double thickness) {
  const double w = (before.thickness - thickness) / (before.thickness - beyond.thickness);
  return {{before.state.reference, (1 - w) * before.state.x + w * beyond.state.x,
           (1 - w) * before.state.p + w * beyond.state.p},
          before.memory,
          (1 - w) * before.plates_moved + w * beyond.plates_moved};
}

Guess extrapolate(const Waypoint& here, const Waypoint* before, double thickness) {
  Guess guess{here.state, here.memory, here.plates_moved};
  if (before == nullptr) return guess;
  const double ratio = (thickness - here.thickness) / (here.thickness - before->thickness);
  guess.state.x += ratio * (here.moved.x - before->state.x);
  guess.state.p += ratio * (here.moved.p - before->state.p);
  extrapolate_bounds(before->memory, ratio, guess.memory);
  return guess;
}

void Trail::begin(Waypoint start) {
  start_ = here_ = std::move(start);
}

void Trail::advance(Waypoint next) {
  if (before_) earlier_.push_back(std::move(*before_));
  if (earlier_.size() > longest_trail) earlier_.pop_front();
  before_ = std::move(here_);
  here_ = std::move(next);
}

void Trail::end_between(Waypoint before, Waypoint last) {
  before_ = std::move(before);
  here_ = std::move(last);
}

bool Trail::step_back() {
  if (!before_ && here_.thickness == start_.thickness) return false;
  here_ = before_ ? std::move(*before_) : start_;
  before_.reset();
  if (earlier_.empty()) return true;
  before_ = std::move(earlier_.back());
  earlier_.pop_back();
  return true;
}

void Trail::restart_at(Waypoint earlier) {
  here_ = std::move(earlier);
  before_.reset();
  earlier_.clear();
}

}  // namespace breast
