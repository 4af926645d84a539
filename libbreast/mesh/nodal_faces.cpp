// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/nodal_faces.hpp"

#include <Eigen/Geometry>

#include "mesh/gauss.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {
struct QuadPoint {
  double weight;
  QuadShape shape;
};
/// 3×3 Gauss points: exact areas of flat faces of both orders.
std::vector<QuadPoint> quad_rule(int order) {
  std::vector<QuadPoint> rule;
  for (const auto& [at, weight] : gauss_square(3)) rule.push_back({weight, quad_shape(order, at)});
  return rule;
}
}  // namespace

NodalFaces nodal_faces(const HexTopology& mesh, const std::vector<Face>& faces,
                       const Eigen::VectorXd& x, const FaceWeight& weight) {
  const auto count = std::size_t(x.size() / 3);
  NodalFaces spread{std::vector<double>(count, 0), std::vector<Vec3>(count, Vec3::Zero())};
  const std::vector<QuadPoint> rule = quad_rule(mesh.order);
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const QuadPoint& point : rule) {
      Vec3 at = Vec3::Zero(), a1 = Vec3::Zero(), a2 = Vec3::Zero();
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Vec3 position = x.segment<3>(3 * nodes[k]);
        at += point.shape.values[Eigen::Index(k)] * position;
        a1 += point.shape.gradients(0, Eigen::Index(k)) * position;
        a2 += point.shape.gradients(1, Eigen::Index(k)) * position;
      }
      const Vec3 dA = point.weight * a1.cross(a2);
      const double area = (weight ? weight(at, dA.normalized()) : 1) * dA.norm();
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double share = point.shape.values[Eigen::Index(k)];
        spread.area[std::size_t(nodes[k])] += share * area;
        spread.vector[std::size_t(nodes[k])] += share * dA;
      }
    }
  }
  return spread;
}

}  // namespace breast
