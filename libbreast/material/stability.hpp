// SPDX-License-Identifier: GPL-3.0-or-later
// Range of strains in which a law is strongly elliptic (every shear on every plane has positive
// stiffness).
#pragma once

#include <string>

#include "material/law.hpp"

namespace breast {

/// Second derivative of W (Pa) along the simple shear F ← (I + ε m⊗n)F with unit m ⟂ n, at the
/// left Cauchy–Green tensor b with det b = 1. At rest it is the shear modulus for every m, n.
double directional_shear_modulus(const Law& law, const Mat3& b, const Vec3& m, const Vec3& n);

/// Smallest directional shear modulus over all planes (sampled every ~10°), relative to rest.
double weakest_shear(const Law& law, const Mat3& b);

/// Range of uniaxial stretch around 1, within [low, high], where the
/// weakest shear stays above zero.
struct StableRange {
  double compression = 1, tension = 1;  ///< stretches λ
  double weakest = 1;                   ///< smallest relative shear modulus met on the way
};
StableRange stable_range(const Law& law, double low = 0.3, double high = 3.0);

/// Whether the law declares that its constants are elliptic wherever it is defined.
bool always_elliptic(const Law& law);

/// Margin of the constants against loss of ellipticity: 1 if no constant acts against it, 0 at the
/// bound. As the law declares it; for constants that it does not prove, the smallest relative shear
/// modulus over stretches 0.5–2.
struct EllipticityMargin {
  double value = 0;
  bool every_stretch = false;  ///< proven for all stretches of the law, or only scanned over 0.5–2
};
EllipticityMargin ellipticity_margin(const Law& law);

/// Throws Error (input), beginning with `where`, unless the law is usable: right number of finite
/// constants that the law allows, positive rest modulus, and elliptic: as the law declares, or else by a
/// scan of stretches 0.5–2.
void check_law(const Law& law, const std::string& where);

}  // namespace breast
