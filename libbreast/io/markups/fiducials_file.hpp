// SPDX-License-Identifier: GPL-3.0-or-later
// Point lists in the format of 3D Slicer before 4.11 (.fcsv); private to io/markups.
#pragma once

#include <filesystem>
#include <vector>

#include "io/markups_file.hpp"

namespace breast {

/// All points in LPS; the header's CoordinateSystem says what they are stated in (LPS or RAS, in older
/// files 1 or 0). Throws Error (input) for a header without it or without columns, and for coordinates
/// that are not three numbers of mm.
std::vector<MarkupPoint> read_fiducials(const std::filesystem::path& file);

}  // namespace breast
