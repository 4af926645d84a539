// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/body/side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double clear_fall = 15;  // mm: sternum and flank differ by tens
constexpr double at_border = 6;    // mm from the last column

/// Mean depth of the skin per column (mm); the grid's depth where a slice has none.
std::vector<double> mean_depths(const HeightField& skin, double deepest) {
  std::vector<double> mean(skin.nx, 0);
  for (int i = 0; i < skin.nx; ++i) {
    for (int k = 0; k < skin.nz; ++k) {
      const double depth = skin.at(i, k);
      mean[i] += (std::isnan(depth) ? deepest : depth) / skin.nz;
    }
  }
  return mean;
}

}  // namespace

double fall_to_the_left(const TorsoFront& torso, const Grid& grid) {
  const auto mean = mean_depths(torso.skin, grid.size[1] * grid.spacing[1]);
  const auto tip = std::min_element(mean.begin(), mean.end());
  return *std::max_element(tip, mean.end()) - *std::max_element(mean.begin(), tip + 1);
}

void refuse_other_side(const TorsoFront& torso, const Grid& grid, Side side) {
  const Side other = side == Side::left ? Side::right : Side::left;
  if (torso.one_breast) {
    const double fall = fall_to_the_left(torso, grid) * lateral_sign(side);
    if (fall > -clear_fall) return;
    throw input_error("the only breast in the field of view is the ", side_name(other),
                      " one, not the ", side_name(side), ": its skin falls back ",
                      std::lround(-fall), " mm more on the patient's ", side_name(other),
                      " than on the ", side_name(side), " (sternum and flank; at most ", clear_fall,
                      " mm accepted): give --side ", side_name(other),
                      ", or a scan that shows the ", side_name(side), " breast");
  }
  // The most anterior column of the side, by its mean over the slices.
  const auto mean = mean_depths(torso.skin, grid.size[1] * grid.spacing[1]);
  const bool left = side == Side::left;
  const auto first = left ? mean.begin() + torso.midline : mean.begin();
  const auto last = left ? mean.end() : mean.begin() + torso.midline + 1;
  const auto tip = std::min_element(first, last);
  const double beyond = double(left ? mean.end() - 1 - tip : tip - mean.begin()) * grid.spacing[0];
  if (beyond > at_border) return;
  throw input_error("the field of view ends at the tip of the ", side_name(side),
                    " breast: its most anterior skin lies ", std::lround(beyond),
                    " mm from the last column (more than ", at_border,
                    " expected): give a scan that shows the whole breast, or --side ",
                    side_name(other));
}

}  // namespace breast
