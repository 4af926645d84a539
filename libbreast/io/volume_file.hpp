// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of image volumes: NRRD, NIfTI or MetaImage by file extension, or a DICOM series
// from a folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "image/volume.hpp"
#include "io/scan_choice.hpp"

namespace breast {

/// A DICOM scan by its UIDs, for what is made of it to refer to.
struct DicomReference {
  std::string study_uid, series_uid, frame_of_reference_uid, sop_class;
  std::vector<std::string>
      instance_uids;  ///< of its files, each once; empty if it is no DICOM scan
};

/// The source of a volume, as described in messages.
struct VolumeSource {
  std::string
      description;  ///< "nrrd", "DICOM series 3: 40 files of 512 x 512 pixels, series number 7"
  std::string
      patient_position;    ///< of a DICOM series, as "HFP" (head first, prone); "" if not stated
  std::string patient_id;  ///< of a DICOM series, only for comparison; "" if not stated
  std::string
      contrast;  ///< of a DICOM series, as its header states it: "T1", "water"; "not stated"
  /// What was taken and what was passed over in a DICOM folder, a line each.
  std::vector<std::string> remarks;
  DicomReference dicom;
  std::string content_sha256;  ///< of grid and voxels, the same for NRRD and DICOM of one scan
};

/// Reads any scalar volume as float. Of a DICOM folder, with all that lies below it, the series asked for, or
/// else the best (series_rule); an Error (input) lists those that are equally good. Refuses missing
/// slices, slices that are not equally spaced (1 %, or places within 0.1 mm), non-finite voxels, and colour and vector images.
Volume<float> read_volume(const std::filesystem::path& file, const ScanChoice& choice = {},
                          VolumeSource* source = nullptr);
/// The series of a DICOM folder, a row each: number, images, pixels, voxel size, contrast by the header, time
/// point, sides, and whether it would be taken or why not. `remarks` receives what was passed over. No description, which may hold a name.
Table list_series(const std::filesystem::path& folder, const ScanChoice& choice,
                  std::vector<std::string>& remarks);
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
