// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/sliding_nodes.hpp"

#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace {
// Newton's method along the gradient gains digits quadratically; a step is a few millimetres and
// the surface curves over a hundred.
constexpr int most_corrections = 12;
// mm; rounding of a distance computed from coordinates of some hundred mm is a hundredth of it.
constexpr double on_level = 1e-11, acceptable = 1e-8;
}  // namespace

Level level_at_wall_node(const LevelSurface& surface, int node, const Vec3& place) {
  const std::optional<Level> level = surface.at(place);
  if (!level) {
    throw input_error("mesh: wall node ", node, " at ", place.transpose(),
                      " mm lies outside the known part of the chest-wall surface; run "
                      "fit-hermite again, or use --wall held");
  }
  return *level;
}

SlidingNodes::SlidingNodes(std::shared_ptr<const LevelSurface> surface, std::vector<int> nodes,
                           const Eigen::VectorXd& imaged)
    : surface_(std::move(surface)) {
  cells_.nodes_per_cell = 1;
  cells_.nodes = std::move(nodes);
  for (const int node : cells_.nodes) {
    const Vec3 place = imaged.segment<3>(3L * node);
    levels_.push_back(level_at_wall_node(*surface_, node, place).value);
  }
}

bool SlidingNodes::hold(const Eigen::VectorXd& x, Constraints& all) const {
  for (const int node : cells_.nodes) {
    const std::optional<Level> level = surface_->at(x.segment<3>(3L * node));
    if (!level) return false;
    all.hold_along(node, level->gradient.normalized());
  }
  return true;
}

int SlidingNodes::restore(Eigen::VectorXd& x) const {
  for (int i = 0; i < cells_.count(); ++i) {
    auto place = x.segment<3>(3L * cells_.nodes[std::size_t(i)]);
    double off = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_corrections && !(std::abs(off) <= on_level); ++k) {
      const std::optional<Level> level = surface_->at(place);
      if (!level) return cells_.nodes[std::size_t(i)];
      off = level->value - levels_[std::size_t(i)];
      place -= off / level->gradient.squaredNorm() * level->gradient;
    }
    if (!(std::abs(off) <= acceptable)) return cells_.nodes[std::size_t(i)];
  }
  return -1;
}

Eigen::VectorXd SlidingNodes::way_back(const Eigen::VectorXd& x, const Constraints& held) const {
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(x.size()), off = gradient;
  for (int i = 0; i < cells_.count(); ++i) {
    const long at = 3L * cells_.nodes[std::size_t(i)];
    const std::optional<Level> level = surface_->at(x.segment<3>(at));
    if (!level) return {};
    gradient.segment<3>(at) = level->gradient;
    off[at] = level->value - levels_[std::size_t(i)];
  }
  Eigen::VectorXd across = gradient, moves = Eigen::VectorXd::Zero(x.size());
  held.project(across);
  across = gradient - across;
  for (const int node : cells_.nodes) {
    const long at = 3L * node;
    const Vec3 direction = across.segment<3>(at);
    const double rate = direction.dot(gradient.segment<3>(at));
    // If the normal has turned by more than 60 degrees, a first-order step is meaningless.
    if (rate > 0.25 * gradient.segment<3>(at).squaredNorm()) {
      moves.segment<3>(at) = -off[at] / rate * direction;
    }
  }
  return moves;
}

bool SlidingNodes::add_curvature(const State& state, const Request& request,
                                 const Forces& forces) const {
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  if (packed == nullptr && request.matrix == nullptr) return true;
  for (int i = 0; i < cells_.count(); ++i) {
    const long at = 3L * cells_.nodes[std::size_t(i)];
    const std::optional<Level> level = surface_->at(state.x.segment<3>(at));
    if (!level) return false;
    const double multiplier =
        forces.r.segment<3>(at).dot(level->gradient) / level->gradient.squaredNorm();
    const Mat3 block = -multiplier * level->hessian;
    if (request.matrix != nullptr)
      request.matrix->stiffness.add_to_node(cells_.nodes[std::size_t(i)], block);
    if (packed != nullptr) packed->set(i, block.data());
  }
  return true;
}

}  // namespace breast
