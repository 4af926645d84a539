// SPDX-License-Identifier: GPL-3.0-or-later
// Outline of the breast (skin line) in a real or simulated mammogram.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "matching/image_axes.hpp"
#include "projection/framing.hpp"
#include "projection/mammogram_scan.hpp"

namespace breast {

struct OutlinePoint {
  Vec2 at;      ///< mm
  Vec2 normal;  ///< unit, out of the breast
};

/// Border between the breast and the air in front of it, in mm along the image axes, with points
/// about 0.3 mm apart. Air is the region connected to the anterior border that is not brighter than
/// its noise plus 1 % of the breast's grey value; letters and markers in the air are ignored, and
/// the borders of the axes' field are not part of the outline. Throws Error (input) beginning with
/// `where` if there is no breast or no air.
std::vector<OutlinePoint> image_outline(const MammogramScan& scan, const ImageAxes& axes,
                                        const std::string& where);

/// Border of the simulated view's tissue in front of its posterior edge, mm in (u,v), about 0.4 mm
/// apart and exact to 0.01 mm. `tissue` tells whether a column holds any.
std::vector<Vec2> simulated_outline(const std::function<bool(const Vec2&)>& tissue,
                                    const ImageFrame& frame);

}  // namespace breast
