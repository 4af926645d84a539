// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/plane_stress.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

/// Twice differentiable step from x* up to x, over the width w to either side of x*, as a function
/// of x − x*.
struct Step {
  double value = 0, slope = 0, bend = 0;
};

Step smooth_positive(double over, double width) {
  const double u = std::clamp((over + width) / (2 * width), 0.0, 1.0);
  if (u == 1) return {over, 1, 0};
  return {2 * width * u * u * u * (1 - 0.5 * u), u * u * (3 - 2 * u),
          6 * u * (1 - u) / (2 * width)};
}

/// The effective squared stretch in one direction, with its derivatives with respect to the squared
/// stretch x of that direction and y of the other: x, but not below the value under uniaxial
/// tension along y.
struct Effective {
  double value = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

Effective effective(double x, double y, double width) {
  const Step tense = smooth_positive(y - 1, width);
  const double along = 1 + tense.value;  // max(y, 1)
  const double least = 1 / std::sqrt(along);
  const double least_1 = -0.5 * least / along, least_2 = 0.75 * least / (along * along);
  const double ly = least_1 * tense.slope;
  const double lyy = least_2 * tense.slope * tense.slope + least_1 * tense.bend;
  const Step m = smooth_positive(x - least, width);
  return {least + m.value, m.slope,      ly * (1 - m.slope),
          m.bend,          -m.bend * ly, lyy * (1 - m.slope) + m.bend * ly * ly};
}

/// ψ and its derivatives with respect to the squared principal stretches.
struct Principal {
  double f = 0, f1 = 0, f2 = 0, f11 = 0, f12 = 0, f22 = 0;
};

bool relaxed(const Law& law, double width, double c1, double c2, Principal& out) {
  const Effective a = effective(c1, c2, width), b = effective(c2, c1, width);
  PlaneStress w;
  if (!plane_stress(law, a.value + b.value, a.value * b.value, w)) return false;
  // First with respect to the effective stretches: I = a + b, d = ab.
  const double wa = w.fi + b.value * w.fd, wb = w.fi + a.value * w.fd;
  const double waa = w.fii + 2 * b.value * w.fid + b.value * b.value * w.fdd;
  const double wbb = w.fii + 2 * a.value * w.fid + a.value * a.value * w.fdd;
  const double wab = w.fii + (a.value + b.value) * w.fid + a.value * b.value * w.fdd + w.fd;
  // `a` has its x along 1, `b` along 2.
  const double a1 = a.x, a2 = a.y, b1 = b.y, b2 = b.x;
  out.f = w.f;
  out.f1 = wa * a1 + wb * b1;
  out.f2 = wa * a2 + wb * b2;
  out.f11 = waa * a1 * a1 + 2 * wab * a1 * b1 + wbb * b1 * b1 + wa * a.xx + wb * b.yy;
  out.f22 = waa * a2 * a2 + 2 * wab * a2 * b2 + wbb * b2 * b2 + wa * a.yy + wb * b.xx;
  out.f12 = waa * a1 * a2 + wab * (a1 * b2 + a2 * b1) + wbb * b1 * b2 + wa * a.xy + wb * b.xy;
  return true;
}

/// Conversion from squared stretches to I and d. Where the stretches are equal, the formulas are
/// 0/0 of a smooth function: the stretches are then moved apart by `apart`, which changes the
/// result by its square.
struct Stretches {
  double c1 = 0, c2 = 0, gap = 0;
};

Stretches principal_stretches(double i, double d, double apart) {
  const double half = std::sqrt(std::max(0.25 * i * i - d, 0.25 * apart * apart));
  return {0.5 * i + half, 0.5 * i - half, 2 * half};
}

constexpr double apart_for_forces = 1e-7, apart_for_tangent = 1e-3;

}  // namespace

Invariants12 effective_invariants(double width, double i, double d) {
  const Stretches c = principal_stretches(i, d, apart_for_forces);
  const double a = effective(c.c1, c.c2, width).value, b = effective(c.c2, c.c1, width).value;
  return {a + b + 1 / (a * b), a * b + (a + b) / (a * b)};
}

bool plane_stress(const Law& law, double i, double d, PlaneStress& out) {
  const double i1 = i + 1 / d, i2 = d + i / d;
  if (!law.in_range(i1, i2)) return false;
  const LawValue w = law.evaluate(i1, i2);
  const double down = -1 / (d * d), up = 1 - i / (d * d);  // ∂I1/∂d, ∂I2/∂d
  out.f = w.w;
  out.fi = w.w1 + w.w2 / d;
  out.fd = w.w1 * down + w.w2 * up;
  out.fii = w.w11 + 2 * w.w12 / d + w.w22 / (d * d);
  out.fid = w.w11 * down + w.w12 * (up + down / d) + w.w22 * up / d - w.w2 / (d * d);
  out.fdd = w.w11 * down * down + 2 * w.w12 * down * up + w.w22 * up * up + 2 * w.w1 / (d * d * d) +
            2 * w.w2 * i / (d * d * d);
  return true;
}

bool tension_field(const Law& law, double kept, double width, double i, double d,
                   PlaneStress& out) {
  PlaneStress full;
  if (!plane_stress(law, i, d, full)) return false;
  const Stretches near = principal_stretches(i, d, apart_for_forces);
  // With both directions under tension, ψ is the law itself.
  if (near.c1 >= 1 + width && near.c2 >= 1 / std::sqrt(near.c1) + width) {
    out = full;
    return true;
  }
  Principal p;
  if (!relaxed(law, width, near.c1, near.c2, p)) return false;
  PlaneStress slack;
  slack.f = p.f;
  slack.fi = (near.c1 * p.f1 - near.c2 * p.f2) / near.gap;
  slack.fd = (p.f2 - p.f1) / near.gap;
  const Stretches far = principal_stretches(i, d, apart_for_tangent);
  if (!relaxed(law, width, far.c1, far.c2, p)) return false;
  const double g = far.gap, g2 = g * g, g3 = g2 * g, c1 = far.c1, c2 = far.c2;
  // Derivatives of c1, c2 = I/2 ± √(I²/4 − d).
  slack.fdd = (p.f11 - 2 * p.f12 + p.f22) / g2 - 2 * (p.f1 - p.f2) / g3;
  slack.fid = (-c1 * p.f11 + (c1 + c2) * p.f12 - c2 * p.f22) / g2 + (c1 + c2) * (p.f1 - p.f2) / g3;
  slack.fii = (c1 * c1 * p.f11 - 2 * c1 * c2 * p.f12 + c2 * c2 * p.f22) / g2 -
              2 * c1 * c2 * (p.f1 - p.f2) / g3;
  const double rest = 1 - kept;
  out = {kept * full.f + rest * slack.f,     kept * full.fi + rest * slack.fi,
         kept * full.fd + rest * slack.fd,   kept * full.fii + rest * slack.fii,
         kept * full.fid + rest * slack.fid, kept * full.fdd + rest * slack.fdd};
  return true;
}

}  // namespace breast
