// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a drawn picture as PNG, with VTK.
#pragma once

#include <filesystem>

#include "image/colour_picture.hpp"

namespace breast {

/// 8 bits a channel, pixel for pixel.
void write_picture_png(const std::filesystem::path& file, const ColourPicture& picture);

}  // namespace breast
