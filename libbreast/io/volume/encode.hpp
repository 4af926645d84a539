// SPDX-License-Identifier: GPL-3.0-or-later
// Encoding of a volume as the bytes of a file, for each format; private to io/volume.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/volume.hpp"

namespace breast {

/// The type of a voxel under its name in each format.
struct VoxelType {
  const char* nrrd;
  const char* meta;
  int nifti, bits;
};

/// `voxels`: the values in memory order, little-endian. nifti_bytes throws Error (input) for more than
/// 32767 voxels along an axis, which the format cannot state.
std::string nrrd_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels);
/// The same with notes ("key:=value" lines) and with `components` adjacent numbers per voxel, which NRRD
/// calls an axis of kind "vector".
std::string nrrd_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels,
                       const std::vector<std::pair<std::string, std::string>>& notes,
                       int components);
std::string meta_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels);
std::string nifti_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels);

/// Compresses to one gzip stream, whose comment names libbreast as its writer; identical content gives
/// identical bytes.
std::string gzip_bytes(std::string_view content);

}  // namespace breast
