// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/curves.hpp"

#include <cmath>
#include <limits>

namespace breast {

namespace {

// 2 factor (W1 + part W2).
double stress(const Law& law, double i1, double i2, double factor, double part) {
  if (!law.in_range(i1, i2)) return std::numeric_limits<double>::quiet_NaN();
  const LawValue w = law.evaluate(i1, i2);
  return 2 * factor * (w.w1 + part * w.w2);
}

}  // namespace

double uniaxial_stress(const Law& law, double stretch) {
  const double square = stretch * stretch;
  return stress(law, square + 2 / stretch, 2 * stretch + 1 / square, stretch - 1 / square,
                1 / stretch);
}

double equibiaxial_stress(const Law& law, double stretch) {
  const double square = stretch * stretch;
  return stress(law, 2 * square + 1 / (square * square), 2 / square + square * square,
                stretch - std::pow(stretch, -5), square);
}

double pure_shear_stress(const Law& law, double stretch) {
  const double i = 1 + stretch * stretch + 1 / (stretch * stretch);
  return stress(law, i, i, stretch - std::pow(stretch, -3), 1);
}

double simple_shear_stress(const Law& law, double shear) {
  const double i = 3 + shear * shear;
  return stress(law, i, i, shear, 1);
}

}  // namespace breast
