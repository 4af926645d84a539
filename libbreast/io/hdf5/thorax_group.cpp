// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/thorax_group.hpp"

#include <numbers>

namespace breast {

namespace {
const std::string thorax_group = "/breast/thorax";
constexpr int most_intervals = 10000;
}  // namespace

void put_thorax(Document& document, const ThoraxSurface& thorax) {
  auto& attributes = document.attributes;
  attributes[thorax_group + "@origin"] = array_of(thorax.origin);
  attributes[thorax_group + "@slope"] = array_of(thorax.slope);
  attributes[thorax_group + "@angles"] = array_of(Doubles{thorax.angle_low, thorax.angle_high});
  attributes[thorax_group + "@heights"] = array_of(Doubles{thorax.height_low, thorax.height_high});
  document.datasets[thorax_group + "/radius"] =
      reshaped(array_of(Doubles(thorax.coefficients)),
               {std::size_t(thorax.heights) + 3, std::size_t(thorax.angles) + 3});
  attributes[thorax_group + "@intervals"] = array_of(Integers{thorax.angles, thorax.heights});
}

bool has_thorax(const Fields& fields) {
  return fields.has_group(thorax_group);
}

ThoraxSurface get_thorax(Fields& fields) {
  const Complaint& complain = fields.complain();
  ThoraxSurface thorax;
  thorax.origin = fields.place(thorax_group + "@origin");
  thorax.slope = fields.number(thorax_group + "@slope");
  const Doubles angles = fields.numbers(thorax_group + "@angles", 2);
  const Doubles heights = fields.numbers(thorax_group + "@heights", 2);
  const Integers intervals = fields.integer_list(thorax_group + "@intervals", 2);
  for (const std::int64_t n : intervals) {
    if (!(n >= 1 && n <= most_intervals)) {
      throw complain("attribute ", thorax_group, "@intervals is ", n, ", must be 1 to ",
                     most_intervals);
    }
  }
  thorax.angle_low = angles[0], thorax.angle_high = angles[1];
  thorax.height_low = heights[0], thorax.height_high = heights[1];
  thorax.angles = int(intervals[0]), thorax.heights = int(intervals[1]);
  if (!(-std::numbers::pi <= angles[0] && angles[0] < angles[1] && angles[1] <= std::numbers::pi)) {
    throw complain("attribute ", thorax_group, "@angles is ", angles[0], " and ", angles[1],
                   ", must ascend within -pi and pi");
  }
  if (!(heights[0] < heights[1] && heights[1] - heights[0] <= Fields::farthest_mm)) {
    throw complain("attribute ", thorax_group, "@heights is ", heights[0], " and ", heights[1],
                   " mm, must ascend");
  }
  if (!(std::abs(thorax.slope) <= 10)) {
    throw complain("attribute ", thorax_group, "@slope is ", thorax.slope, ", must be within 10");
  }
  thorax.coefficients = fields.doubles(
      thorax_group + "/radius", {std::size_t(thorax.heights) + 3, std::size_t(thorax.angles) + 3});
  for (const double radius : thorax.coefficients) {
    if (!(radius > 0 && radius <= Fields::farthest_mm)) {
      throw complain("dataset ", thorax_group, "/radius holds ", radius, " mm, must be above 0");
    }
  }
  return thorax;
}

}  // namespace breast
