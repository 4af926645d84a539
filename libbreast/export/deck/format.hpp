// SPDX-License-Identifier: GPL-3.0-or-later
// Formatting of numbers and names in input files of other solvers. Internal to deck/.
#pragma once

#include <cstdio>
#include <map>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "material/law.hpp"

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

/// `body` of a law's LawExport with the values of its constants, and of `others`, in place of {NAME}.
inline std::string with_constants(std::string_view body, const Law& law,
                                  std::map<std::string_view, double> others = {}) {
  for (std::size_t k = 0; k < law.constants.size(); ++k) {
    others[law.kind->constants[k].name] = law.constants[k];
  }
  std::string text;
  while (!body.empty()) {
    const std::size_t open = body.find('{');
    text += body.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t close = body.find('}', open);
    const auto value = others.find(body.substr(open + 1, close - open - 1));
    if (close == std::string_view::npos || value == others.end()) {
      throw failed_error("law ", law.kind->name, ": its form in another program, '", body,
                         "', names no constant");
    }
    text += deck_number(value->second);
    body.remove_prefix(close + 1);
  }
  return text;
}

}  // namespace breast
