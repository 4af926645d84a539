// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a DICOM file as text, without a DICOM library.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace breast {

/// Elements of a DICOM file at top level, as text; key "GGGG|EEEE" in lower-case hex.
/// Only elements of at most 256 bytes are kept.
using DicomHeader = std::map<std::string, std::string>;

/// Reads all elements of a DICOM file. Returns false if the file is not DICOM at all; throws Error
/// (input) if it is, but is damaged, truncated, or in an unsupported transfer syntax.
bool read_dicom_header(const std::filesystem::path& file, DicomHeader& header);

}  // namespace breast
