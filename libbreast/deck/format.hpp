// SPDX-License-Identifier: GPL-3.0-or-later
// Formatting of numbers and names in input files of other solvers. Internal to deck/.
#pragma once

#include <cstdio>
#include <string>

#include "core/types.hpp"

namespace breast {

/// Twelve digits: CalculiX reads no more than 20 characters of a field.
inline std::string deck_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.12g", value);
  return buffer;
}

inline std::string deck_vector(const Vec3& v) {
  return deck_number(v.x()) + "," + deck_number(v.y()) + "," + deck_number(v.z());
}

}  // namespace breast
