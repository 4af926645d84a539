// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/units.hpp"

#include <array>

#include "core/error.hpp"

namespace breast {

namespace {
constexpr std::array<std::string_view, 4> posture_names = {"prone", "supine", "upright", "off"};
}

std::string_view posture_name(Posture posture) {
  return posture_names.at(static_cast<std::size_t>(posture));
}

Posture posture_from_name(std::string_view name) {
  for (std::size_t code = 0; code < posture_names.size(); ++code) {
    if (posture_names[code] == name) return static_cast<Posture>(code);
  }
  throw input_error("unknown posture '", name, "'; use prone, supine, upright or off");
}

Vec3 posture_gravity(Posture posture) {
  switch (posture) {
    case Posture::prone:
      return {0, -gravity_mm_s2, 0};
    case Posture::supine:
      return {0, gravity_mm_s2, 0};
    case Posture::upright:
      return {0, 0, -gravity_mm_s2};
    case Posture::weightless:
      break;
  }
  return Vec3::Zero();
}

}  // namespace breast
