#include "core/units.hpp"

#include "core/error.hpp"

namespace breast {

Vec3 posture_gravity(std::string_view posture) {
  if (posture == "prone") return {0, -gravity_mm_s2, 0};
  if (posture == "supine") return {0, gravity_mm_s2, 0};
  if (posture == "upright") return {0, 0, -gravity_mm_s2};
  if (posture == "off") return Vec3::Zero();
  throw input_error("unknown posture '", posture, "'; use prone, supine, upright or off");
}

}  // namespace breast
