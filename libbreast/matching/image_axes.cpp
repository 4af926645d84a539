// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/image_axes.hpp"

#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

// The letters of an orientation are coarse; half the direction must be along the axis.
double sign_along(const Vec3& direction, const Vec3& axis, const char* what,
                  const std::string& where) {
  const double length = direction.norm(), along = direction.dot(axis);
  if (!(length > 0)) {
    throw input_error(where,
                      ": the patient orientation (such as A\\R) is missing, so that the "
                      "orientation of the image is unknown");
  }
  if (!(std::abs(along) >= 0.5 * length)) {
    throw input_error(where, ": patient orientation: its ", what,
                      " are not the axes of a mammogram; rotate the image");
  }
  return along > 0 ? 1 : -1;
}

}  // namespace

ImageAxes::ImageAxes(const MammogramHeader& header, const ViewPose& pose, const std::string& where)
    : mm_per_pixel_(header.pixel_mm * sign_along(header.right, pose.e_u, "rows", where),
                    header.pixel_mm * sign_along(header.down, pose.e_v, "columns", where)),
      last_pixel_(header.columns - 1, header.rows - 1) {}

bool ImageAxes::contains(const Vec2& mm, double margin) const {
  const Vec2 at = pixel(mm);
  const double inside = margin / std::abs(mm_per_pixel_.x());
  return (at.array() >= inside).all() && (at.array() <= last_pixel_.array() - inside).all();
}

double ImageAxes::posterior_border() const {
  return anterior_is_right() ? mm(Vec2(-0.5, 0)).x() : mm(Vec2(last_pixel_.x() + 0.5, 0)).x();
}

}  // namespace breast
