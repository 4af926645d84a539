// SPDX-License-Identifier: GPL-3.0-or-later
// Units and patient frame: mm, g and s, hence stress in Pa and force in µN (1 N = 1e6 µN); LPS
// axes, x to the patient's left, y posterior, z superior.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/types.hpp"

namespace breast {

inline constexpr double gravity_mm_s2 = 9810.0;
inline constexpr double micronewton_per_newton = 1.0e6;
inline constexpr double pascal_per_kilopascal = 1.0e3;
inline constexpr double mm3_per_ml = 1.0e3;
inline constexpr double mm2_per_cm2 = 1.0e2;
inline constexpr double cm_per_mm = 0.1;

/// How the patient lies or stands; `weightless`: no gravity at all.
enum class Posture : std::uint8_t { prone, supine, upright, weightless };
/// "prone", "supine", "upright" or "off".
std::string_view posture_name(Posture posture);
/// Inverse of posture_name; throws Error (input) naming the choices.
Posture posture_from_name(std::string_view name);
/// mm/s², LPS.
Vec3 posture_gravity(Posture posture);

}  // namespace breast
