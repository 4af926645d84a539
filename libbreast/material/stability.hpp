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

/// The smallest value of e^{b(λ²+2/λ−3)}/λ² over uniaxial stretches λ, for `b` > 0: 0.929 at b =
/// 4.4, 0.743 at b = 1. The exponential law keeps every shear modulus positive while ab e^{b(I1−3)}
/// + cλ² > 0 on the weakest plane, that is, while −c < exponential_bound(b) ab.
double exponential_bound(double b);

/// True where a closed condition proves ellipticity at every isochoric stretch: convex and
/// nondecreasing in both invariants, or exponential with −c < exponential_bound(b) ab.
bool always_elliptic(const Law& law);

/// Margin of the constants against loss of ellipticity: 1 if no constant acts against it, 0 at the
/// bound. Exponential law: 1 − |c|/(exponential_bound(b) ab); convex polynomial: 1 − α11²/(4 α20
/// α02); otherwise the smallest relative shear modulus over stretches 0.5–2.
struct EllipticityMargin {
  double value = 0;
  bool every_stretch = false;  ///< proven for all stretches, or only scanned over 0.5–2
};
EllipticityMargin ellipticity_margin(const Law& law);

/// Throws Error (input), beginning with `where`, unless the law is usable: right number of finite
/// constants, positive rest modulus, and elliptic: by the closed conditions (polynomial: convex and
/// nondecreasing; exponential: −c < exponential_bound(b) ab), or else by a scan of stretches 0.5–2.
void check_law(const Law& law, const std::string& where);

}  // namespace breast
