// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of image volumes with ITK: NRRD, NIfTI or MetaImage by file extension, or a
// DICOM series from a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "image/volume.hpp"

namespace breast {

/// The source of a volume, as described in messages.
struct VolumeSource {
  std::string
      description;  ///< "nrrd", "DICOM series 3: 40 files of 512 x 512 pixels, series number 7"
  std::string
      patient_position;  ///< of a DICOM series, as "HFP" (head first, prone); "" if not stated
  std::string content_sha256;  ///< of grid and voxels, the same for NRRD and DICOM of one scan
};

/// Reads any scalar volume as float. `series` (from 1; 0: the only one) selects a DICOM series; for
/// a folder with several series and `series` 0, an Error (input) lists them. Refuses missing
/// slices, spacings that differ by more than 1 %, non-finite voxels, and colour and vector images.
Volume<float> read_volume(const std::filesystem::path& file, int series = 0,
                          VolumeSource* source = nullptr);
/// SHA-256 of grid (rounded to what file formats keep: 1e-3 mm, 1e-4 in directions) and voxels.
std::string content_hash(const Volume<float>& volume);
/// Writes .nrrd (gzip), .nii, .nii.gz or .mha atomically.
void write_volume(const std::filesystem::path& file, const Volume<float>& volume);
void write_volume(const std::filesystem::path& file, const Volume<std::uint8_t>& volume);
/// 16-bit signed, for simulated MR.
void write_volume(const std::filesystem::path& file, const Volume<std::int16_t>& volume);
/// True for the file extensions that write_volume knows, ignoring case.
bool is_volume_name(const std::filesystem::path& file);
/// Throws Error (input) if `folder` contains anything except slices written by write_dicom_series.
void check_dicom_folder(const std::filesystem::path& folder);
/// Writes a DICOM MR series, one file per slice, into `folder`, which is created completely or not
/// at all. An older series of libbreast is replaced; throws Error (input) like check_dicom_folder.
void write_dicom_series(const std::filesystem::path& folder, const Volume<std::int16_t>& volume,
                        const std::string& description);

}  // namespace breast
