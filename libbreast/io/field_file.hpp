// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of vector fields as .nrrd, the form in which ITK and 3D Slicer read displacement fields.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "image/volume.hpp"

namespace breast {

/// Three float32 per grid point (mm, LPS), kinds "vector domain domain domain"; "displacement field
/// type:=resampling", and `notes`, as "key:=value" lines. Writes atomically; throws Error (failed) if the
/// numbers of vectors and grid points differ.
void write_field(const std::filesystem::path& file, const Grid& grid,
                 const std::vector<std::array<float, 3>>& vectors,
                 const std::vector<std::pair<std::string, std::string>>& notes);

}  // namespace breast
