// Units are mm, g, s: stress is then Pa and force µN (1 N = 1e6 µN). Patient frame LPS:
// x to the patient's left, y posterior, z superior.
#pragma once

#include <string_view>

#include "core/types.hpp"

namespace breast {

inline constexpr double gravity_mm_s2 = 9810.0;
inline constexpr double density_g_mm3 = 1.0e-3;
inline constexpr double micronewton_per_newton = 1.0e6;
inline constexpr double pascal_per_kilopascal = 1.0e3;
inline constexpr double mm3_per_ml = 1.0e3;
inline constexpr double mm2_per_cm2 = 1.0e2;

/// Gravity (mm/s^2, LPS) for "prone", "supine", "upright" or "off"; throws Error (input) otherwise.
Vec3 posture_gravity(std::string_view posture);

}  // namespace breast
