// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/hermite_basis.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

/// Cubic Hermite functions at one coordinate: [end][position or slope], with derivatives by the
/// sheet's parameter (n patches over [0,1]).
struct Cubic {
  double f[2][2], d[2][2], dd[2][2];
};

Cubic cubic(double x, double n) {
  Cubic c{};
  c.f[0][0] = 1 - 3 * x * x + 2 * x * x * x;
  c.f[0][1] = x * (x - 1) * (x - 1);
  c.f[1][0] = x * x * (3 - 2 * x);
  c.f[1][1] = x * x * (x - 1);
  c.d[0][0] = n * (-6 * x + 6 * x * x);
  c.d[0][1] = n * (x - 1) * (3 * x - 1);
  c.d[1][0] = n * (6 * x - 6 * x * x);
  c.d[1][1] = n * x * (3 * x - 2);
  c.dd[0][0] = n * n * (-6 + 12 * x);
  c.dd[0][1] = n * n * (6 * x - 4);
  c.dd[1][0] = n * n * (6 - 12 * x);
  c.dd[1][1] = n * n * (6 * x - 2);
  return c;
}

}  // namespace

PatchWeights patch_weights(int nu, int nv, const Vec2& st) {
  PatchWeights w;
  const double u = std::clamp(st.x(), 0.0, 1.0) * nu, v = std::clamp(st.y(), 0.0, 1.0) * nv;
  w.patch_i = std::min(int(u), nu - 1);
  w.patch_j = std::min(int(v), nv - 1);
  const Cubic a = cubic(u - w.patch_i, nu), b = cubic(v - w.patch_j, nv);
  for (int c = 0; c < 4; ++c)
    for (int d = 0; d < 4; ++d) {
      const int i = c & 1, j = c >> 1, p = d & 1, q = d >> 1, n = 4 * c + d;
      w.value[n] = a.f[i][p] * b.f[j][q];
      w.s[n] = a.d[i][p] * b.f[j][q];
      w.t[n] = a.f[i][p] * b.d[j][q];
      w.ss[n] = a.dd[i][p] * b.f[j][q];
      w.st[n] = a.d[i][p] * b.d[j][q];
      w.tt[n] = a.f[i][p] * b.dd[j][q];
    }
  return w;
}

void set_sheet_dofs(HermiteSheet& sheet, const std::vector<Vec3>& dofs) {
  const auto chord = [&](int i, int j, int di, int dj) {
    double sum = 0;
    int count = 0;
    for (const int sign : {-1, 1}) {
      const int a = i + sign * di, b = j + sign * dj;
      if (a < 0 || b < 0 || a > sheet.nu || b > sheet.nv) continue;
      const std::size_t n = std::size_t(j) * (sheet.nu + 1) + i,
                        m = std::size_t(b) * (sheet.nu + 1) + a;
      sum += (dofs[4 * m] - dofs[4 * n]).norm();
      ++count;
    }
    const double mean = sum / count;
    return mean > 1e-9 ? mean : 1.0;
  };
  for (int j = 0; j <= sheet.nv; ++j)
    for (int i = 0; i <= sheet.nu; ++i) {
      HermiteSheet::Node& n = sheet.node(i, j);
      const std::size_t at = 4 * (std::size_t(j) * (sheet.nu + 1) + i);
      n.scale_1 = chord(i, j, 1, 0);
      n.scale_2 = chord(i, j, 0, 1);
      n.x = dofs[at];
      n.x_1 = dofs[at + 1] / n.scale_1;
      n.x_2 = dofs[at + 2] / n.scale_2;
      n.x_12 = dofs[at + 3] / (n.scale_1 * n.scale_2);
    }
}

SheetCurvature curvature(const HermiteSheet& sheet, const Vec2& st) {
  const PatchWeights w = patch_weights(sheet.nu, sheet.nv, st);
  SheetCurvature k{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (int c = 0; c < 4; ++c) {
    const auto& n = sheet.node(w.patch_i + (c & 1), w.patch_j + (c >> 1));
    const Vec3 dof[4] = {n.x, n.scale_1 * n.x_1, n.scale_2 * n.x_2, n.scale_1 * n.scale_2 * n.x_12};
    for (int d = 0; d < 4; ++d) {
      k.x_ss += w.ss[4 * c + d] * dof[d];
      k.x_st += w.st[4 * c + d] * dof[d];
      k.x_tt += w.tt[4 * c + d] * dof[d];
    }
  }
  return k;
}

}  // namespace breast
