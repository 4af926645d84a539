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

ImageAxes::ImageAxes(const Vec2& mm_per_pixel, const MammogramHeader& header)
    : mm_per_pixel_(mm_per_pixel), field_{0, 0, header.columns - 1, header.rows - 1} {}

ImageAxes::ImageAxes(const MammogramHeader& header, const ViewPose& pose, const std::string& where)
    : ImageAxes(header.pixel_mm * Vec2(sign_along(header.right, pose.e_u, "rows", where),
                                       sign_along(header.down, pose.e_v, "columns", where)),
                header) {}

ImageAxes ImageAxes::upright(const MammogramHeader& header, bool anterior_is_right) {
  return {header.pixel_mm * Vec2(anterior_is_right ? 1 : -1, 1), header};
}

bool ImageAxes::contains(const Vec2& mm, double margin) const {
  const Vec2 at = pixel(mm);
  const double inside = margin / std::abs(mm_per_pixel_.x());
  const Vec2 first(field_.left, field_.top), last(field_.right, field_.bottom);
  return (at.array() >= first.array() + inside).all() &&
         (at.array() <= last.array() - inside).all();
}

double ImageAxes::posterior_border() const {
  return anterior_is_right() ? mm(Vec2(field_.left - 0.5, 0)).x()
                             : mm(Vec2(field_.right + 0.5, 0)).x();
}

}  // namespace breast
