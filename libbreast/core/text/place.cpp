// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/text/place.hpp"

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

void check_place_radius(double radius, const std::string& where) {
  if (!(radius > 0 && radius <= 50))
    throw input_error(where, ": radius ", radius, " mm must be above 0 and at most 50");
}

Place parse_place(const std::string& text, const std::string& where) {
  const std::size_t colon = text.find(':');
  Place place;
  std::string rest = text.substr(0, colon);
  for (int d = 0; d < 3; ++d) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string::npos) != (d == 2))
      throw input_error(where, " ", text, ": expected auto, none, a file, or x,y,z[:radius] in mm");
    place.centre[d] = parse_number(rest.substr(0, comma), where);
    if (d < 2) rest = rest.substr(comma + 1);
  }
  if (colon == std::string::npos) return place;
  place.radius = parse_number(text.substr(colon + 1), where + " radius");
  check_place_radius(*place.radius, where + " " + text);
  return place;
}

}  // namespace breast
