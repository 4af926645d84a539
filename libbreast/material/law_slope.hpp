// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a law with respect to its constants, for sensitivities.
#pragma once

#include "material/law.hpp"

namespace breast {

/// ∂(∂W/∂I1)/∂m and ∂(∂W/∂I2)/∂m of one parameter m.
struct LawSlope {
  double w1 = 0, w2 = 0;
};

/// By constants[index], per Pa (per 1 for b of the exponential).
LawSlope law_slope(const Law& law, std::size_t index, double i1, double i2);

/// By the logarithm of a factor on all stiffness constants, as Law::scaled has it.
LawSlope law_scale_slope(const Law& law, double i1, double i2);

}  // namespace breast
