// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/skin_patch.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace breast {

std::vector<SkinFace> skin_faces(const Mask& body, const Vec3& about, double reach) {
  const Grid& grid = body.grid;
  std::array<int, 3> low{}, high{};
  for (int d = 0; d < 3; ++d) {
    low[d] = std::max(0, int(std::floor((about[d] - reach) / grid.spacing[d])));
    high[d] = std::min(grid.size[d] - 1, int(std::ceil((about[d] + reach) / grid.spacing[d])));
  }
  std::vector<SkinFace> faces;
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        if (!body.at(i, j, k)) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            std::array<int, 3> beside{i, j, k};
            beside[axis] += step;
            if (!grid.contains(beside[0], beside[1], beside[2]) ||
                body.at(beside[0], beside[1], beside[2]))
              continue;
            SkinFace face{grid.spacing.cwiseProduct(Vec3(i, j, k)), Vec3::Zero()};
            face.centre[axis] += 0.5 * step * grid.spacing[axis];
            face.area[axis] = step * grid.voxel_volume() / grid.spacing[axis];
            if ((face.centre - about).norm() < reach) faces.push_back(face);
          }
        }
      }
    }
  }
  return faces;
}

TangentFrame tangent_frame(const std::vector<SkinFace>& faces, const Vec3& origin) {
  Vec3 normal = Vec3::Zero();
  for (const SkinFace& face : faces) normal += face.area;
  TangentFrame frame{origin, Vec3::Zero(), Vec3::Zero(), normal.normalized()};
  frame.u = frame.out.unitOrthogonal();
  frame.v = frame.out.cross(frame.u);
  return frame;
}

Quadric monomials(double a, double b) {
  Quadric m;
  m << 1, a, b, a * a, a * b, b * b;
  return m;
}

Quadric quadric_through(const std::vector<SkinFace>& faces, const TangentFrame& frame,
                        double inside, double outside) {
  Eigen::Matrix<double, 6, 6> matrix = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
  Quadric right = Quadric::Zero();
  for (const SkinFace& face : faces) {
    const Vec3 p = frame.local(face.centre);
    const double radius = std::hypot(p[0], p[1]), seen = face.area.dot(frame.out);
    if (!(radius >= inside && radius < outside && seen > 0)) continue;
    const Quadric m = monomials(p[0], p[1]);
    matrix += seen * m * m.transpose();
    right += seen * p[2] * m;
  }
  return matrix.ldlt().solve(right);
}

}  // namespace breast
