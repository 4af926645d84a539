// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of a Mammogram as .vti (float; pose as FieldData) and writing of a 16-bit PNG
// for viewing, with VTK.
#pragma once

#include <filesystem>

#include "projection/mammogram.hpp"

namespace breast {

Mammogram read_mammogram(const std::filesystem::path& file);
void write_mammogram(const std::filesystem::path& file, const Mammogram& image);
/// Writes the image in the clinical orientation: chest wall at the right edge for a right breast
/// and at the left edge for a left one; lateral (CC) or superior (MLO, ML) at the top; dense is
/// bright.
void write_mammogram_png(const std::filesystem::path& file, const Mammogram& image);

}  // namespace breast
