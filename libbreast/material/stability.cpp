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

Mat3 uniaxial(double stretch) {
  return Vec3(stretch * stretch, 1 / stretch, 1 / stretch).asDiagonal();
}

// Last stable stretch on the way from 1 to `end` in even logarithmic steps.
double walk(const Law& law, double end, double& weakest) {
  constexpr int steps = 60;
  double last = 1;
  for (int i = 1; i <= steps; ++i) {
    const double stretch = std::exp(std::log(end) * i / steps);
    const Mat3 b = uniaxial(stretch);
    if (!law.in_range(b.trace(), b.inverse().trace())) break;
    const double relative = weakest_shear(law, b);
    if (!(relative > 0)) break;
    weakest = std::min(weakest, relative);
    last = stretch;
  }
  return last;
}

}  // namespace

StableRange stable_range(const Law& law, double low, double high) {
  StableRange range;
  range.compression = walk(law, low, range.weakest);
  range.tension = walk(law, high, range.weakest);
  return range;
}

bool always_elliptic(const Law& law) {
  return law.kind->margin != nullptr && law.kind->margin(law.constants.data());
}

EllipticityMargin ellipticity_margin(const Law& law) {
  if (!always_elliptic(law)) return {stable_range(law, 0.5, 2).weakest, false};
  return {*law.kind->margin(law.constants.data()), true};
}

void check_law(const Law& law, const std::string& where) {
  const std::size_t expected = law.kind->constants.size();
  if (law.constants.size() != expected) {
    throw input_error(where, ": ", law.constants.size(), " constants given, ", law.kind->name,
                      " needs ", expected);
  }
  for (const double value : law.constants) {
    if (!std::isfinite(value)) throw input_error(where, ": a constant is not a finite number");
  }
  const double modulus = law.shear_modulus();
  if (!(modulus > 0)) {
    throw input_error(where, ": shear modulus at zero strain ", modulus,
                      " Pa must be positive (2(W1+W2) at I1 = I2 = 3)");
  }
  const std::string refusal =
      law.kind->refusal != nullptr ? law.kind->refusal(law.constants.data()) : "";
  if (!refusal.empty()) throw input_error(where, ": ", refusal);
  if (always_elliptic(law)) return;
  const StableRange range = stable_range(law, 0.5, 2.0);
  if (range.compression > 0.501 || range.tension < 1.99) {
    throw input_error(
        where, ": the law loses ellipticity, or ends, outside stretches ", range.compression,
        " to ", range.tension,
        "; constants must keep every shear stiff from 0.5 to 2 (none below 0 suffices, "
        "for a polynomial with 4 a20 a02 >= a11^2)");
  }
}

}  // namespace breast
