// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/elastic_support.hpp"

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"
#include "solve/sliding_nodes.hpp"

namespace breast {

ElasticSupport::ElasticSupport(const HexMesh& mesh, const std::vector<Face>& faces,
                               const SupportStiffness& stiffness,
                               std::shared_ptr<const LevelSurface> surface, const FaceWeight& share)
    : surface_(std::move(surface)) {
  if (!(stiffness.normal > 0 && stiffness.tangential >= 0)) {
    throw input_error("springs of ", stiffness.normal, " and ", stiffness.tangential,
                      " kPa/mm: the first must be above 0, the second 0 or more");
  }
  const NodalFaces spread = nodal_faces(mesh, faces, flatten(mesh.imaged), share);
  cells_.nodes = nodes_of(mesh, faces);
  for (int i = 0; i < cells_.count(); ++i) {
    const auto node = std::size_t(cells_.nodes[std::size_t(i)]);
    const double area = spread.area[node] * pascal_per_kilopascal;
    normals_.push_back(spread.vector[node].normalized());
    const Vec3& imaged = mesh.imaged[node];
    const Level at =
        surface_ ? level_at_wall_node(*surface_, int(node), imaged) : *level(i, imaged);
    along_.push_back(area * stiffness.tangential);
    across_.push_back(area * (stiffness.normal - stiffness.tangential) / at.gradient.squaredNorm());
  }
}

std::optional<Level> ElasticSupport::level(int i, const Vec3& x) const {
  if (surface_) return surface_->at(x);
  const Vec3& normal = normals_[std::size_t(i)];
  return Level{normal.dot(x), normal, Mat3::Zero()};
}

std::optional<NodeSprings::Spring> ElasticSupport::spring(const State& state, int i) const {
  const long at = 3L * cells_.nodes[std::size_t(i)];
  const double along = along_[std::size_t(i)], across = across_[std::size_t(i)];
  const Vec3 x = state.x.segment<3>(at), rest = state.reference.segment<3>(at), moved = x - rest;
  Spring out;
  out.energy = 0.5 * along * moved.squaredNorm();
  out.force = along * moved;
  out.tangent = along * Mat3::Identity();
  out.by_reference = -out.tangent;
  if (across == 0) return out;
  const std::optional<Level> here = level(i, x), there = level(i, rest);
  if (!here || !there) return {};
  const double lifted = here->value - there->value;
  out.energy += 0.5 * across * lifted * lifted;
  out.force += across * lifted * here->gradient;
  out.tangent += across * (here->gradient * here->gradient.transpose() + lifted * here->hessian);
  out.by_reference -= across * here->gradient * there->gradient.transpose();
  return out;
}

}  // namespace breast
