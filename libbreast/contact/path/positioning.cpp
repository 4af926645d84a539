// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/positioning.hpp"

#include <algorithm>
#include <cmath>

#include "contact/compressed_shape.hpp"
#include "contact/path/target.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

/// Depth from the edge over which the traction of the hand rises, mm.
constexpr double pull_ramp_mm = 20;
/// Tissue closer to the edge than this counts as at the edge, mm.
constexpr double at_edge_mm = 10;

}  // namespace

double Release::at(double way) const {
  if (way >= ends - same_part) return 1;
  return std::max(0.0, (way - begins) / (ends - begins));
}

Eigen::VectorXd pull_forwards(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate,
                              double newton) {
  const std::vector<double> area = nodal_faces(mesh, mesh.skin_faces, flatten(x)).area;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3L * mesh.nodes());
  double total = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const auto i = std::size_t(node);
    const double in_front = plate.in_front(x[i]);
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
                                   const Eigen::VectorXd& start, const Eigen::VectorXd& x,
                                   const Plate& plate) {
  PositioningStage stage{std::move(name), coverage(mesh, x, plate).volume, 0};
  double moved = 0;
  int at_edge = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3 before = start.segment<3>(3L * node), now = x.segment<3>(3L * node);
    if (std::abs(plate.in_front(before)) > at_edge_mm) continue;
    moved += (now - before).dot(plate.anterior);
    ++at_edge;
  }
  if (at_edge > 0) stage.past_edge_mm = moved / at_edge;
  return stage;
}

}  // namespace breast
