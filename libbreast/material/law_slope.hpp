// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a law with respect to its constants, for sensitivities.
#pragma once

#include "material/law.hpp"

namespace breast {

/// ∂(∂W/∂I1)/∂m and ∂(∂W/∂I2)/∂m of one parameter m.
struct LawSlope {
  double w1 = 0, w2 = 0;
};

/// Derivative with respect to constants[index], per Pa (dimensionless for b of the exponential).
LawSlope law_slope(const Law& law, std::size_t index, double i1, double i2);

/// Derivative with respect to the logarithm of a factor on all stiffness constants, as in
/// Law::scaled.
LawSlope law_scale_slope(const Law& law, double i1, double i2);

}  // namespace breast
