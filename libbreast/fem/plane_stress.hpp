// SPDX-License-Identifier: GPL-3.0-or-later
// The energy of a thin incompressible skin in plane stress, as a function of two invariants of its
// surface, and the same law without its resistance to compression: a tension field.
#pragma once

#include "material/law.hpp"

namespace breast {

/// f(I, d) per volume (Pa) with I = A^{αβ}a_{αβ} and d = det a / det A, and its derivatives.
struct PlaneStress {
  double f = 0, fi = 0, fd = 0, fii = 0, fid = 0, fdd = 0;
};

/// Evaluates W(I + 1/d, d + I/d). Returns false (and undefined values) if the law is out of range.
bool plane_stress(const Law& law, double i, double d, PlaneStress& out);

/// The relaxed energy of Pipkin (IMA J. Appl. Math. 36, 1986). Where a principal stretch falls
/// below that of uniaxial tension, skin wrinkles instead of being compressed, and only the other
/// stretch counts; where both are below 1 it is slack. The transition is twice continuously
/// differentiable over `width` (in squared stretches) to either side; above it, the energy is the
/// law itself. The fraction `kept` of the law remains everywhere, so that slack skin still has a
/// stiffness; `kept` 0 gives the relaxed energy alone.
bool tension_field(const Law& law, double kept, double width, double i, double d, PlaneStress& out);

/// The invariants I1 and I2 at which tension_field evaluates the law for its relaxed energy.
struct Invariants12 {
  double i1 = 0, i2 = 0;
};
Invariants12 effective_invariants(double width, double i, double d);

}  // namespace breast
