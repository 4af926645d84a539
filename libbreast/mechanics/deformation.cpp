// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/deformation.hpp"

#include <Eigen/LU>
#include <cmath>

namespace breast {

Mat3 deformation_gradient(const HexMesh& mesh, int element, const HexShape& shape,
                          const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed) {
  Mat3 from = Mat3::Zero(), to = Mat3::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a) {
    const auto node = std::size_t(mesh.element(element)[a]);
    from += reference[node] * shape.gradients.col(a).transpose();
    to += deformed[node] * shape.gradients.col(a).transpose();
  }
  return to * from.inverse();
}

Mat3 isochoric_stretch_at_centre(const HexMesh& mesh, int element,
                                 const std::vector<Vec3>& reference,
                                 const std::vector<Vec3>& deformed) {
  const Mat3 f =
      deformation_gradient(mesh, element, hex_shape(mesh.order, Vec3::Zero()), reference, deformed);
  const double third = std::cbrt(f.determinant());
  return f * f.transpose() / (third * third);
}

}  // namespace breast
