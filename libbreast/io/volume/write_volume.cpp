// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lower_case.hpp"
#include "io/volume/encode.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

std::string encoded(const std::filesystem::path& file, const Grid& grid, const VoxelType& type,
                    std::string_view voxels) {
  const std::string name = lower_case(file.filename().string());
  if (name.ends_with(".nrrd")) return nrrd_bytes(grid, type, voxels);
  if (name.ends_with(".mha")) return meta_bytes(grid, type, voxels);
  if (name.ends_with(".nii")) return nifti_bytes(grid, type, voxels);
  if (name.ends_with(".nii.gz")) return gzip_bytes(nifti_bytes(grid, type, voxels));
  throw input_error(file.string(), ": volumes are written as .nrrd, .nii, .nii.gz or .mha");
}

template <class T>
void write_any(const std::filesystem::path& file, const Volume<T>& volume, const VoxelType& type) {
  if (volume.voxels.size() != volume.grid.voxels() || volume.voxels.empty()) {
    throw failed_error(file.string(), ": ", volume.voxels.size(), " voxels for a grid of ",
                       volume.grid.voxels());
  }
  const std::string_view bytes(reinterpret_cast<const char*>(volume.voxels.data()),
                               volume.voxels.size() * sizeof(T));
  write_bytes(file, encoded(file, volume.grid, type, bytes));
}

}  // namespace

void write_volume(const std::filesystem::path& file, const Volume<float>& volume) {
  write_any(file, volume, {"float", "MET_FLOAT", 16, 32});
}
void write_volume(const std::filesystem::path& file, const Volume<std::uint8_t>& volume) {
  write_any(file, volume, {"uchar", "MET_UCHAR", 2, 8});
}
void write_volume(const std::filesystem::path& file, const Volume<std::int16_t>& volume) {
  write_any(file, volume, {"short", "MET_SHORT", 4, 16});
}

bool is_volume_name(const std::filesystem::path& file) {
  const std::string name = lower_case(file.filename().string());
  for (const char* ending : {".nrrd", ".nii", ".nii.gz", ".mha"}) {
    if (name.ends_with(ending)) return true;
  }
  return false;
}

}  // namespace breast
