// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/stability.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace breast {

// Under F ← (I + ε m⊗n)F: I1 = tr b + 2ε m·bn + ε² n·bn, and with det = 1 I2 = tr b⁻¹ − 2ε n·b⁻¹m +
// ε² m·b⁻¹m; the chain rule gives the rest.
double directional_shear_modulus(const Law& law, const Mat3& b, const Vec3& m, const Vec3& n) {
  const Mat3 inverse = b.inverse();
  const LawValue w = law.evaluate(b.trace(), inverse.trace());
  const double i1 = 2 * m.dot(b * n), i2 = -2 * n.dot(inverse * m);
  return 2 * w.w1 * n.dot(b * n) + 2 * w.w2 * m.dot(inverse * m) + w.w11 * i1 * i1 +
         2 * w.w12 * i1 * i2 + w.w22 * i2 * i2;
}

double weakest_shear(const Law& law, const Mat3& b) {
  constexpr int polar = 9, azimuth = 18, turns = 18;
  double weakest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= polar; ++i) {
    const double theta = 0.5 * std::numbers::pi * i / polar;
    for (int j = 0; j < azimuth; ++j) {
      const double phi = std::numbers::pi * j / azimuth * 2;
      const Vec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta));
      const Vec3 t = n.unitOrthogonal(), s = n.cross(t);
      for (int k = 0; k < turns; ++k) {
        const double psi = std::numbers::pi * k / turns;
        const Vec3 m = std::cos(psi) * t + std::sin(psi) * s;
        const double modulus = directional_shear_modulus(law, b, m, n);
        if (!(modulus >= weakest)) weakest = modulus;
      }
    }
  }
  return weakest / law.shear_modulus();
}

namespace {

constexpr int exponential_steps = 60;  // of Newton's method; a dozen suffice for b near one

Mat3 uniaxial(double stretch) {
  return Vec3(stretch * stretch, 1 / stretch, 1 / stretch).asDiagonal();
}

// Last stable stretch on the way from 1 to `end` in even logarithmic steps.
double walk(const Law& law, double end, double& weakest) {
  constexpr int steps = 60;
  double last = 1;
  for (int i = 1; i <= steps; ++i) {
    const double stretch = std::exp(std::log(end) * i / steps);
    if (!law.in_range(uniaxial(stretch).trace())) break;
    const double relative = weakest_shear(law, uniaxial(stretch));
    if (!(relative > 0)) break;
    weakest = std::min(weakest, relative);
    last = stretch;
  }
  return last;
}

// Convex and nondecreasing in (I1−3, I2−3): polyconvex under det F = 1.
bool convex(const Law& law) {
  const std::vector<double>& c = law.constants;
  for (const double value : c) {
    if (!(value >= 0)) return false;
  }
  return law.kind != LawKind::polynomial || 4 * c[2] * c[3] >= c[4] * c[4];
}

}  // namespace

// The minimum lies where bλ³ − λ − b = 0, λ > 1; from the right Newton's method falls to it without
// passing it.
double exponential_bound(double b) {
  double stretch = 1 + 1 / b;
  for (int i = 0; i < exponential_steps; ++i) {
    const double square = stretch * stretch;
    stretch -= (b * square * stretch - stretch - b) / (3 * b * square - 1);
  }
  return std::exp(b * (stretch * stretch + 2 / stretch - 3)) / (stretch * stretch);
}

StableRange stable_range(const Law& law, double low, double high) {
  StableRange range;
  range.compression = walk(law, low, range.weakest);
  range.tension = walk(law, high, range.weakest);
  return range;
}

bool always_elliptic(const Law& law) {
  if (law.kind != LawKind::exponential) return convex(law);
  const double a = law.constants[0], b = law.constants[1], c = law.constants[2];
  return a > 0 && b > 0 && c > -exponential_bound(b) * a * b;
}

EllipticityMargin ellipticity_margin(const Law& law) {
  if (!always_elliptic(law)) return {stable_range(law, 0.5, 2).weakest, false};
  const std::vector<double>& k = law.constants;
  if (law.kind == LawKind::exponential) {
    return {1 - std::max(0.0, -k[2]) / (exponential_bound(k[1]) * k[0] * k[1]), true};
  }
  if (law.kind == LawKind::polynomial && k[4] > 0) {
    return {1 - k[4] * k[4] / (4 * k[2] * k[3]), true};
  }
  return {1, true};
}

void check_law(const Law& law, const std::string& where) {
  const std::size_t expected = law_constant_names(law.kind).size();
  if (law.constants.size() != expected) {
    throw input_error(where, ": ", law.constants.size(), " constants given, ",
                      law_kind_name(law.kind), " needs ", expected);
  }
  for (const double value : law.constants) {
    if (!std::isfinite(value)) throw input_error(where, ": a constant is not a finite number");
  }
  const double modulus = law.shear_modulus();
  if (!(modulus > 0)) {
    throw input_error(where, ": shear modulus at zero strain ", modulus,
                      " Pa must be positive (2(W1+W2) at I1 = I2 = 3)");
  }
  if (law.kind == LawKind::exponential) {
    const double a = law.constants[0], b = law.constants[1], c = law.constants[2];
    if (!(a > 0) || !(b > 0)) throw input_error(where, ": a and b must be positive");
    const double bound = exponential_bound(b);
    if (!(c > -bound * a * b)) {
      throw input_error(where, ": c = ", c, " Pa loses ellipticity: with b = ", b,
                        " it must exceed -", bound, " ab = ", -bound * a * b,
                        " Pa (Veronda-Westmann has c = -ab/2)");
    }
    return;
  }
  if (always_elliptic(law)) return;
  const StableRange range = stable_range(law, 0.5, 2.0);
  if (range.compression > 0.501 || range.tension < 1.99) {
    throw input_error(where, ": the law loses ellipticity outside stretches ", range.compression,
                      " to ", range.tension,
                      "; constants must keep every shear stiff from 0.5 to 2 (all a >= 0 and 4 a20 "
                      "a02 >= a11^2 suffice for a polynomial)");
  }
}

}  // namespace breast
