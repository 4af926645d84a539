// SPDX-License-Identifier: GPL-3.0-or-later
// How a mammogram hangs: from its Patient Orientation, and from the side on which it shows air.
#pragma once

#include <string>

#include "matching/image_axes.hpp"
#include "matching/image_field.hpp"

namespace breast {

struct Hanging {
  ImageAxes axes;
  /// Whether the header also says which way is up; if not, both must be tried.
  bool upright_known = true;
  std::string doubt;  ///< what the header states otherwise than the image shows; empty if nothing
};

/// The side with air is anterior. Where the header says otherwise, the image is mirrored if the machine
/// states that it flipped it (Field of View Horizontal Flip); else, or without Patient Orientation, which
/// way is up remains unknown. Throws Error (input) beginning with `where` as ImageAxes, and if neither
/// header nor image shows where anterior is.
Hanging hang_image(const MammogramHeader& header, const ViewPose& pose,
                   const std::optional<AirSeen>& air, const std::string& where);

}  // namespace breast
