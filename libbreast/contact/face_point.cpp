// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/face_point.hpp"

#include <Eigen/Geometry>

namespace breast {

FacePoint face_point(const std::vector<int>& nodes, const std::vector<Vec3>& x,
                     const QuadShape& shape) {
  FacePoint point;
  Vec3 a1 = Vec3::Zero(), a2 = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vec3& node = x[std::size_t(nodes[k])];
    point.at += shape.values[Eigen::Index(k)] * node;
    a1 += shape.gradients(0, Eigen::Index(k)) * node;
    a2 += shape.gradients(1, Eigen::Index(k)) * node;
  }
  point.area = a1.cross(a2);
  return point;
}

}  // namespace breast
