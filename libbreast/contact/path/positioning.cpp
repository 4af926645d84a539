// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/positioning.hpp"

#include <algorithm>
#include <cmath>

#include "contact/compressed_shape.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

/// The plates bear the weight from this reduction on, and from a smaller one if a force ends the
/// path. The hand begins to release the weight at this fraction of that reduction.
constexpr double bears_weight = 0.25, bears_weight_before_any_force = 0.1, begins_part = 0.2;
/// On a path to a small reduction, this fraction of it is used instead.
constexpr double latest_part = 0.5;
/// Friction takes over the pull between these fractions of the reduction.
constexpr double pull_begins_part = 0.6, pull_ends_part = 0.9;
/// The fractions are smaller if another target may end the path before that reduction.
constexpr double early_begins_part = 0.5, early_ends_part = 0.8;
/// Depth from the edge over which the traction of the hand rises, mm.
constexpr double pull_ramp_mm = 20;
/// Difference of reductions that counts as none.
constexpr double rounding = 1e-9;
/// Tissue closer to the edge than this counts as at the edge, mm.
constexpr double at_edge_mm = 10;

Release release_by(double reduction) {
  return {begins_part * reduction, reduction};
}

}  // namespace

double Release::at(double reduction) const {
  // A path that stops at `ends` has its reduction from a thickness, with rounding.
  if (reduction >= ends - rounding) return 1;
  return std::max(0.0, (reduction - begins) / (ends - begins));
}

Grip grip_before(double reduction, bool may_end_before) {
  const double begins = may_end_before ? early_begins_part : pull_begins_part;
  const double ends = may_end_before ? early_ends_part : pull_ends_part;
  return {release_by(std::min(bears_weight, latest_part * reduction)),
          {begins * reduction, ends * reduction}};
}

Grip grip_before_any_force() {
  const Release early = release_by(bears_weight_before_any_force);
  return {early, early};
}

Eigen::VectorXd pull_forwards(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate,
                              double newton) {
  const std::vector<double> area = nodal_faces(mesh, mesh.skin_faces, flatten(x)).area;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3L * mesh.nodes());
  double total = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const auto i = std::size_t(node);
    const double in_front = x[i].dot(plate.anterior) - plate.edge_start;
    const double share = area[i] * std::clamp(in_front / pull_ramp_mm, 0.0, 1.0);
    force.segment<3>(3L * node) = share * plate.anterior;
    total += share;
  }
  if (!(total > 0)) {
    throw input_error(
        "no skin lies in front of the plates' edge, so that there is nothing to "
        "pull forwards");
  }
  return newton * micronewton_per_newton / total * force;
}

PositioningStage positioning_stage(std::string name, const HexMesh& mesh,
                                   const Eigen::VectorXd& upright, const Eigen::VectorXd& x,
                                   const Plate& plate) {
  PositioningStage stage{std::move(name), coverage(mesh, x, plate).volume, 0};
  double moved = 0;
  int at_edge = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3 before = upright.segment<3>(3L * node), now = x.segment<3>(3L * node);
    if (std::abs(before.dot(plate.anterior) - plate.edge_start) > at_edge_mm) continue;
    moved += (now - before).dot(plate.anterior);
    ++at_edge;
  }
  if (at_edge > 0) stage.past_edge_mm = moved / at_edge;
  return stage;
}

}  // namespace breast
