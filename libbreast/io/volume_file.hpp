// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of image volumes with ITK: NRRD, NIfTI or MetaImage by file extension, or a
// DICOM series from a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "image/volume.hpp"

namespace breast {

/// Series found in a DICOM folder, as listed by error messages.
struct VolumeSource {
  std::string description;     ///< "NRRD", "DICOM series 3: T1 TSE, 40 slices"
  std::string content_sha256;  ///< of grid and voxels, the same for NRRD and DICOM of one scan
};

/// Reads any scalar volume as float. `series` (1-based, 0 = the only one) picks a DICOM series; a folder
/// with several and series 0 is an input Error listing them. Refuses missing slices, non-uniform
/// spacing beyond 1 %, non-finite voxels, colour and vector images.
Volume<float> read_volume(const std::filesystem::path& file, int series = 0,
                          VolumeSource* source = nullptr);
/// Writes .nrrd (gzip), .nii, .nii.gz or .mha atomically.
void write_volume(const std::filesystem::path& file, const Volume<float>& volume);
void write_volume(const std::filesystem::path& file, const Volume<std::uint8_t>& volume);
/// 16-bit signed, for simulated MR.
void write_volume(const std::filesystem::path& file, const Volume<std::int16_t>& volume);
/// True for the endings write_volume knows, in any case.
bool is_volume_name(const std::filesystem::path& file);
/// Throws Error (input) when `folder` holds anything but slices write_dicom_series wrote.
void check_dicom_folder(const std::filesystem::path& folder);
/// DICOM MR series, one file per slice, into `folder` (created; complete or absent). An older series of
/// ours is replaced; throws Error (input) as check_dicom_folder.
void write_dicom_series(const std::filesystem::path& folder, const Volume<std::int16_t>& volume,
                        const std::string& description);

}  // namespace breast
