// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/self_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "contact/penetration.hpp"
#include "core/units.hpp"
#include "mesh/gauss.hpp"
#include "mesh/locate.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

/// Parts of the body nearer than this in front of a face touch it, mm: the plates' own accuracy, ten
/// times.
constexpr double touching_mm = 0.5;

/// A point of a face in the deformed shape.
struct FacePoint {
  Vec3 at{0, 0, 0}, outward{0, 0, 0};
  double area = 0;  ///< mm² that it stands for
};

FacePoint face_point(const std::vector<int>& nodes, const std::vector<Vec3>& x,
                     const QuadShape& shape, double weight) {
  FacePoint point;
  Vec3 a1 = Vec3::Zero(), a2 = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3& node = x[std::size_t(nodes[k])];
    point.at += shape.values[Eigen::Index(k)] * node;
    a1 += shape.gradients(0, Eigen::Index(k)) * node;
    a2 += shape.gradients(1, Eigen::Index(k)) * node;
  }
  const Vec3 area = a1.cross(a2);
  point.area = weight * area.norm();
  point.outward = area.normalized();
  return point;
}

double depth_in_thorax(const HexMesh& mesh, const Vec3& at) {
  if (!mesh.geometry || !mesh.geometry->thorax) return 0;
  const std::optional<Level> level = mesh.geometry->thorax->at(at);
  return level ? std::max(0.0, -level->value / level->gradient.norm()) : 0;
}

}  // namespace

SelfContact self_contact(const HexMesh& mesh, const std::vector<Vec3>& x) {
  const Locator body(mesh, x);
  SelfContact found;
  for (const Face& face : touchable_faces(mesh)) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const auto& [local, weight] : gauss_square(2)) {
      const FacePoint point = face_point(nodes, x, quad_shape(mesh.order, local), weight);
      if (body.find(point.at + touching_mm * point.outward)) {
        found.itself_cm2 += point.area / mm2_per_cm2;
      }
      found.into_thorax_mm = std::max(found.into_thorax_mm, depth_in_thorax(mesh, point.at));
    }
  }
  return found;
}

}  // namespace breast
