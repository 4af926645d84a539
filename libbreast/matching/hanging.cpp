// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/hanging.hpp"

namespace breast {

Hanging hang_image(const MammogramHeader& header, const ViewPose& pose,
                   const std::optional<AirSeen>& air, const std::string& where) {
  if (!air || (header.right.norm() > 0 && header.down.norm() > 0)) {
    const ImageAxes stated(header, pose, where);
    if (!air || air->at_right == stated.anterior_is_right()) return {stated, true, ""};
    if (header.flipped) {
      return {stated.mirrored(), true,
              "mirrored after its patient orientation was written (Field of View Horizontal Flip)"};
    }
    return {stated.mirrored(), false,
            std::string("its air is at the ") + (air->at_right ? "right" : "left") +
                ", where its patient orientation says the chest is"};
  }
  const ImageAxes found = ImageAxes::upright(header, air->at_right);
  return {found, false, "its patient orientation is missing"};
}

}  // namespace breast
