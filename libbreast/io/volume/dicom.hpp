// SPDX-License-Identifier: GPL-3.0-or-later
// The series of a DICOM folder; private to io/volume.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/volume.hpp"

namespace breast {

struct DicomSeries {
  std::string uid;
  int number = 0;
  int columns = 0, rows = 0;
  std::string patient_position;              ///< "HFP", head first and prone; "" if not stated
  std::vector<std::filesystem::path> files;  ///< in the order found
  /// "40 files of 512 x 512 pixels, series number 3". Not its description, in which anything may
  /// stand, also names: messages and reports are sent to others.
  std::string label() const;
};

/// All image series of a folder, in the order of series number, then UID.
std::vector<DicomSeries> list_dicom_series(const std::filesystem::path& folder);
/// Reads one series, slices sorted by position along the slice normal. Throws Error (input).
Volume<float> read_dicom_series(const std::filesystem::path& folder, const DicomSeries& series);

}  // namespace breast
