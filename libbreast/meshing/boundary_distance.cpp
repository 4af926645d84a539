// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/boundary_distance.hpp"

#include <Eigen/Geometry>

#include "mesh/shape.hpp"

namespace breast {

namespace {

void sample_face(const BodyMap& body, Hull part, const Face& face, const PlacedNodes& nodes,
                 const HexMesh& mesh, std::vector<WeightedDistance>& samples) {
  constexpr int along = 5;
  const std::vector<int> list = face_nodes(mesh, face);
  std::vector<Vec2> at;
  for (int c = 0; c < 4; ++c) at.push_back(hull_point_of_node(body, part, nodes, list[c]).at);
  for (int s = 0; s < along * along; ++s) {
    const Vec2 local = Vec2(s % along + 0.5, s / along + 0.5) * (2.0 / along) - Vec2::Ones();
    const QuadShape shape = quad_shape(mesh.order, local), corner = quad_shape(1, local);
    Vec3 x = Vec3::Zero(), along_xi = Vec3::Zero(), along_eta = Vec3::Zero();
    for (std::size_t a = 0; a < list.size(); ++a) {
      x += shape.values[a] * mesh.points[list[a]];
      along_xi += shape.gradients(0, a) * mesh.points[list[a]];
      along_eta += shape.gradients(1, a) * mesh.points[list[a]];
    }
    const std::vector<double> weights(corner.values.begin(), corner.values.end());
    const HullPoint on = nearest_on_hull(body, part, mean_parameters(part, at, weights), x);
    samples.push_back({(on.x - x).norm(), along_xi.cross(along_eta).norm()});
  }
}

}  // namespace

Distances boundary_distance(const BodyMap& body, Hull part, const std::vector<Face>& faces,
                            const PlacedNodes& nodes, const HexMesh& mesh) {
  std::vector<WeightedDistance> samples;
  for (const Face& face : faces) sample_face(body, part, face, nodes, mesh, samples);
  return summarise(std::move(samples));
}

}  // namespace breast
