// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/terms/friction.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace breast {

FrictionForce friction_force(const Vec3& x, const Vec3& anchor, const Vec3& normal, double bound,
                             double stick) {
  FrictionForce friction;
  if (!(bound > 0)) {
    friction.slips = true;
    return friction;
  }
  const Mat3 tangential = Mat3::Identity() - normal * normal.transpose();
  const Vec3 trial = -stick * (tangential * (x - anchor));
  const double size = trial.norm();
  if (size <= bound) {
    friction.force = trial;
    friction.stiffness = stick * tangential;
    friction.energy = 0.5 * size * size / stick;
    return friction;
  }
  const Vec3 along = trial / size;
  friction.slips = true;
  friction.force = bound * along;
  friction.stiffness = bound / size * stick * (tangential - along * along.transpose());
  friction.energy = bound * (size - 0.5 * bound) / stick;
  return friction;
}

Vec3 FrictionTerm::next_anchor(const FrictionEntry& entry, const Eigen::VectorXd& x) const {
  const Vec3 place = x.segment<3>(3L * entry.node);
  if (!(entry.stick > 0)) return place;
  return place + at(entry, x).force / entry.stick;
}

Vec3 kept_normal(const Plate& plate, const Vec3& anchor, const Vec3& x) {
  constexpr double least_sine = 0.01, least_slip = 1e-9;  // mm; below it the line is rounding
  const Vec3 here = plate.gap(x).gradient, slid = x - anchor;
  if (!(slid.norm() > least_slip)) return here;
  const Vec3 along = slid.normalized(), across = here - here.dot(along) * along;
  return across.norm() > least_sine ? across.normalized() : along.unitOrthogonal();
}

void FrictionTerm::set_entries(std::vector<FrictionEntry> entries) {
  entries_ = std::move(entries);
  cells_.nodes_per_cell = 1;
  cells_.nodes.clear();
  for (const FrictionEntry& entry : entries_) cells_.nodes.push_back(entry.node);
}

FrictionForce FrictionTerm::at(const FrictionEntry& entry, const Eigen::VectorXd& x) const {
  const Vec3 point = x.segment<3>(3L * entry.node);
  return friction_force(point, entry.anchor, normal_at(entry, point), entry.bound, entry.stick);
}

Vec3 FrictionTerm::normal_at(const FrictionEntry& entry, const Vec3& point) const {
  return entry.normal ? *entry.normal : plates_.plate(entry.plate).gap(point).gradient;
}

Vec3 FrictionTerm::anchor_in_plane(const FrictionEntry& entry, const Eigen::VectorXd& x) const {
  const Vec3 point = x.segment<3>(3L * entry.node), normal = normal_at(entry, point);
  return entry.anchor + (point - entry.anchor).dot(normal) * normal;
}

Eigen::VectorXd FrictionTerm::change_of_forces(
    const Eigen::VectorXd& x, int plate,
    const std::function<Vec3(int plate, const Vec3& x)>& velocity) const {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(x.size());
  for (const FrictionEntry& entry : entries_) {
    if (plate >= 0 && entry.plate != plate) continue;
    const Vec3 place = x.segment<3>(3L * entry.node);
    change.segment<3>(3L * entry.node) += at(entry, x).stiffness * velocity(entry.plate, place);
  }
  return change;
}

bool FrictionTerm::add(const State& state, const Request& request, Forces& forces) const {
  PackedCells* packed = request.packed != nullptr ? &request.packed->next(cells_) : nullptr;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int node = entries_[i].node;
    const FrictionForce now = at(entries_[i], state.x);
    forces.energy += now.energy;
    forces.r.segment<3>(3L * node) -= now.force;
    if (request.kappa != nullptr) forces.augmented.segment<3>(3L * node) -= now.force;
    if (request.matrix != nullptr) request.matrix->stiffness.add_to_node(node, now.stiffness);
    if (packed != nullptr) packed->set(int(i), now.stiffness.data());
  }
  return true;
}

std::vector<int> FrictionTerm::nodes() const {
  std::vector<int> all = cells_.nodes;
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace breast
