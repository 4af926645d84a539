// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/hermite.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace breast {

namespace {

struct Basis {
  double value0[2], value1[2];  // H0i (position), H1i (derivative) at the two ends
  double slope0[2], slope1[2];
};

Basis hermite_basis(double x) {
  Basis b{};
  b.value0[0] = 1 - 3 * x * x + 2 * x * x * x;
  b.value0[1] = x * x * (3 - 2 * x);
  b.value1[0] = x * (x - 1) * (x - 1);
  b.value1[1] = x * x * (x - 1);
  b.slope0[0] = -6 * x + 6 * x * x;
  b.slope0[1] = 6 * x - 6 * x * x;
  b.slope1[0] = (x - 1) * (3 * x - 1);
  b.slope1[1] = x * (3 * x - 2);
  return b;
}

struct Located {
  int patch;
  double local;
};

Located locate(double s, int patches) {
  const double scaled = std::clamp(s, 0.0, 1.0) * patches;
  const int patch =
      scaled > 0 ? std::min(int(scaled), patches - 1) : 0;  // also where s is not a number
  return {patch, scaled - patch};
}

}  // namespace

Vec3 SheetPoint::normal() const {
  return x_s.cross(x_t).normalized();
}

SheetPoint HermiteSheet::evaluate(const Vec2& st) const {
  const Located u = locate(st.x(), nu), v = locate(st.y(), nv);
  const Basis bu = hermite_basis(u.local), bv = hermite_basis(v.local);
  SheetPoint point{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const Node& n = node(u.patch + i, v.patch + j);
      const Vec3 d1 = n.scale_1 * n.x_1, d2 = n.scale_2 * n.x_2;
      const Vec3 d12 = n.scale_1 * n.scale_2 * n.x_12;
      const auto add = [&](Vec3& target, const double* u0, const double* u1, const double* v0,
                           const double* v1) {
        target +=
            u0[i] * v0[j] * n.x + u1[i] * v0[j] * d1 + u0[i] * v1[j] * d2 + u1[i] * v1[j] * d12;
      };
      add(point.x, bu.value0, bu.value1, bv.value0, bv.value1);
      add(point.x_s, bu.slope0, bu.slope1, bv.value0, bv.value1);
      add(point.x_t, bu.value0, bu.value1, bv.slope0, bv.slope1);
    }
  }
  point.x_s *= nu;
  point.x_t *= nv;
  return point;
}

Vec3 HermiteSheet::position(const Vec2& st) const {
  return evaluate(st).x;
}

}  // namespace breast
