// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/trilinear.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "mesh/gauss.hpp"

namespace breast {

namespace {
// Of the hexahedron's corners in VTK order.
constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
}  // namespace

Vec3 Trilinear::corner(int a) {
  return {double(sign[a][0]), double(sign[a][1]), double(sign[a][2])};
}

Trilinear Trilinear::through(const std::array<Vec3, 8>& corners) {
  Trilinear map;
  map.c.fill(Vec3::Zero());
  for (int a = 0; a < 8; ++a) {
    const int x = sign[a][0], y = sign[a][1], z = sign[a][2];
    const int weights[8] = {1, x, y, z, x * y, y * z, z * x, x * y * z};
    for (int k = 0; k < 8; ++k) map.c[k] += 0.125 * weights[k] * corners[a];
  }
  return map;
}

Vec3 Trilinear::at(const Vec3& l) const {
  return c[0] + l.x() * (c[1] + l.y() * (c[4] + l.z() * c[7]) + l.z() * c[6]) +
         l.y() * (c[2] + l.z() * c[5]) + l.z() * c[3];
}

Mat3 Trilinear::jacobian(const Vec3& l) const {
  Mat3 j;
  j.col(0) = c[1] + l.y() * c[4] + l.z() * c[6] + l.y() * l.z() * c[7];
  j.col(1) = c[2] + l.x() * c[4] + l.z() * c[5] + l.x() * l.z() * c[7];
  j.col(2) = c[3] + l.y() * c[5] + l.x() * c[6] + l.x() * l.y() * c[7];
  return j;
}

bool Trilinear::invert(const Vec3& x, double tolerance, Vec3& local) const {
  Vec3 l = local;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Vec3 residual = x - at(l);
    if (residual.squaredNorm() <= tolerance * tolerance) {
      local = l;
      return true;
    }
    const Mat3 j = jacobian(l);
    const Vec3 yz = j.col(1).cross(j.col(2)), zx = j.col(2).cross(j.col(0));
    const double det = j.col(0).dot(yz);
    if (!(std::abs(det) > 1e-14)) return false;
    const Vec3 xy = j.col(0).cross(j.col(1));
    l += Vec3(yz.dot(residual), zx.dot(residual), xy.dot(residual)) / det;  // Cramer's rule
    if (!(l.cwiseAbs().maxCoeff() < 3)) return false;
  }
  return false;
}

double Trilinear::volume() const {
  // det J is at most quadratic in each coordinate: two Gauss points a direction are exact.
  const std::vector<double> at = gauss_line(2).at;
  double sum = 0;
  for (const double x : at) {
    for (const double y : at) {
      for (const double z : at) sum += jacobian({x, y, z}).determinant();
    }
  }
  return sum;
}

}  // namespace breast
