// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses of an incompressible law in homogeneous states, Pa; not a number where the law is not defined.
#pragma once

#include "material/law.hpp"

namespace breast {

/// Nominal stress at a stretch λ: 2(λ − λ⁻²)(W1 + W2/λ).
double uniaxial_stress(const Law& law, double stretch);
/// The same in two directions: 2(λ − λ⁻⁵)(W1 + λ²W2).
double equibiaxial_stress(const Law& law, double stretch);
/// Nominal stress at a stretch whose transverse direction is held: 2(λ − λ⁻³)(W1 + W2).
double pure_shear_stress(const Law& law, double stretch);
/// Shear stress at a shear γ: 2(W1 + W2)γ.
double simple_shear_stress(const Law& law, double shear);

}  // namespace breast
