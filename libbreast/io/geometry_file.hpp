// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of a BreastGeometry as a VTKHDF file (schema "geometry/1"): /VTKHDF has the
// body's boundary as quads for viewing, /breast/hermite the sheets. HDF5 only.
#pragma once

#include <filesystem>

#include "surface/hermite.hpp"

namespace breast {

BreastGeometry read_geometry(const std::filesystem::path& file);
void write_geometry(const std::filesystem::path& file, const BreastGeometry& geometry);

}  // namespace breast
