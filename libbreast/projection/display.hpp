// SPDX-License-Identifier: GPL-3.0-or-later
// A mammogram prepared for display: clinical orientation, window, 16 bits.
#pragma once

#include <cstdint>
#include <vector>

#include "projection/mammogram.hpp"

namespace breast {

/// The image in rows from the top. The chest wall is at the left edge for a left breast and at the
/// right edge for a right one; lateral (CC) or superior (MLO, ML) is at the top; dense tissue is
/// bright. Columns that leave through the back are an even grey, with a soft border of two pixels.
struct HungImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> grey;
  double window_high = 0;  ///< compensated path at grey 65535; grey is proportional to its square
};
/// The path corrected to the thickness between the plates, so that the thicker tissue behind them
/// is not saturated. Where the tissue is thicker the correction is complete; where it is thinner
/// (towards the skin) it is the fifth root of the ratio. Same unit and order as `path`.
std::vector<float> compensated_path(const Mammogram& image);
HungImage hang(const Mammogram& image);

}  // namespace breast
