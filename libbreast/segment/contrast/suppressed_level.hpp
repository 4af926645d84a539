// SPDX-License-Identifier: GPL-3.0-or-later
// The coil's sensitivity from suppressed fat, the darkest tissue in front of the chest wall.
#pragma once

#include "segment/tissue/bias.hpp"

namespace breast {

/// Log brightness of suppressed fat, on the grid of `scan`. `allowed` marks where there may be fat:
/// beneath the skin and in front of the chest wall, or where that is not yet known, of the depth of
/// the sternum. A polynomial is laid through the dark end of the tissue in boxes of 25 mm, and bends
/// too little to follow a region in which suppression fails or gland without fat. What is as dark as
/// it is fat, by which fat_bias() then finds the level in detail. Throws Error (input) if there is
/// no such tissue.
BiasField suppressed_level(const Volume<float>& scan, const Mask& allowed,
                           const Volume<float>& skin_distance);

}  // namespace breast
