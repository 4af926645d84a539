// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/field_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/volume/encode.hpp"

namespace breast {

void write_field(const std::filesystem::path& file, const Grid& grid,
                 const std::vector<std::array<float, 3>>& vectors,
                 const std::vector<std::pair<std::string, std::string>>& notes) {
  if (vectors.size() != grid.voxels() || vectors.empty()) {
    throw failed_error(file.string(), ": ", vectors.size(), " vectors for a grid of ",
                       grid.voxels());
  }
  // By this key newer versions of 3D Slicer tell a transform from parent from one to parent ("modeling").
  std::vector<std::pair<std::string, std::string>> lines{{"displacement field type", "resampling"}};
  lines.insert(lines.end(), notes.begin(), notes.end());
  const std::string_view bytes(reinterpret_cast<const char*>(vectors.data()),
                               vectors.size() * sizeof vectors[0]);
  write_bytes(file, nrrd_bytes(grid, {"float", "MET_FLOAT", 16, 32}, bytes, lines, 3));
}

}  // namespace breast
