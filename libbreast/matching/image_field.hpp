// SPDX-License-Identifier: GPL-3.0-or-later
// What the grey values of a mammogram say of it, whatever its header states: where the picture lies within
// its frame, on which side the air is, and whether the air is dark.
#pragma once

#include <optional>
#include <string>

#include "projection/mammogram_scan.hpp"

namespace breast {

/// The picture within frames and padding: its first and last columns and rows.
struct ImageField {
  int left = 0, top = 0, right = 0, bottom = 0;
};

struct AirSeen {
  bool at_right = false;
  bool bright = false;  ///< the grey values are inverted
};

/// Without what surrounds it: lines of one grey value that end at a cut, where many pixels differ from them
/// (a frame, or padding beside tissue), unlike air, in which the breast begins with few. At most a quarter
/// of the image at each side.
ImageField image_field(const MammogramScan& scan);

/// Of the left and right borders of the field, the one whose grey values vary less than half as much shows
/// air; nothing if both are plain. Throws Error (input) beginning with `where` if both show tissue, or neither
/// does and the upper or lower border shows little else: the image is rotated, or is cut in front.
std::optional<AirSeen> seen_air(const MammogramScan& scan, const ImageField& field,
                                const std::string& where);

}  // namespace breast
