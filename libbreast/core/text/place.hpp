// SPDX-License-Identifier: GPL-3.0-or-later
// A place given as text, x,y,z or x,y,z:radius.
#pragma once

#include <optional>
#include <string>

#include "core/types.hpp"

namespace breast {

struct Place {
  Vec3 centre{0, 0, 0};          ///< mm, patient LPS
  std::optional<double> radius;  ///< mm, in (0, 50]
};

/// Parses "x,y,z" or "x,y,z:radius" (mm). Throws Error (input) that begins with `where` and the text, if it
/// is neither, or if the radius is not in (0, 50].
Place parse_place(const std::string& text, const std::string& where);

/// Throws Error (input) that begins with `where` if the radius (mm) is not in (0, 50].
void check_place_radius(double radius, const std::string& where);

}  // namespace breast
