#include "mammo/trilinear.hpp"

#include <Eigen/LU>
#include <cmath>

namespace breast {

Trilinear Trilinear::through(const std::array<Vec3, 8>& corners) {
  constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
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
    const double det = j.determinant();
    if (!(std::abs(det) > 1e-14)) return false;
    l += j.inverse() * residual;
    if (!(l.cwiseAbs().maxCoeff() < 3)) return false;
  }
  return false;
}

double Trilinear::volume() const {
  // det J is at most quadratic in each coordinate: two Gauss points a direction are exact.
  const double g = 1 / std::sqrt(3.0);
  double sum = 0;
  for (const double x : {-g, g}) {
    for (const double y : {-g, g}) {
      for (const double z : {-g, g}) sum += jacobian({x, y, z}).determinant();
    }
  }
  return sum;
}

namespace {
double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}
}  // namespace

int patch_hits(const std::array<Vec2, 4>& p, std::array<PatchHit, 2>& hits) {
  // p0 + s e + r f + s r g = 0; eliminating s: a r² + b r + c = 0.
  const Vec2 e = p[1] - p[0], f = p[3] - p[0], g = p[0] - p[1] + p[2] - p[3];
  const double a = cross(f, g), b = cross(p[0], g) + cross(f, e), c = cross(p[0], e);
  double roots[2];
  int n = 0;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return 0;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  if (q != 0) roots[n++] = c / q;
  if (a != 0 && (n == 0 || q / a != roots[0])) roots[n++] = q / a;
  constexpr double slack = 1e-9;
  int found = 0;
  for (int k = 0; k < n; ++k) {
    const double r = roots[k];
    if (!(r >= -slack && r <= 1 + slack)) continue;
    const Vec2 along = e + r * g;
    const double length2 = along.squaredNorm();
    if (!(length2 > 0)) continue;
    const double s = -(p[0] + r * f).dot(along) / length2;
    if (!(s >= -slack && s <= 1 + slack)) continue;
    hits[found++] = {s, r};
  }
  return found;
}

}  // namespace breast
