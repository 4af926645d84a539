// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of mammograms as DICOM (Digital Mammography X-Ray Image Storage), with GDCM.
#pragma once

#include <filesystem>
#include <optional>

#include "projection/mammogram.hpp"
#include "projection/mammogram_scan.hpp"

namespace breast {

/// Header data of the file besides the image.
struct MammogramDicom {
  bool for_processing = false;  ///< detector signal, linear; else as displayed (display.hpp)
  std::optional<double> thickness_mm, force_N, reduction_percent;
};

/// Writes one file, explicit little endian, 16 bits, in the clinical orientation. The UIDs are
/// derived from the content, so that the same image gives the same file. Throws Error (input) if
/// the detector signal of a tissue-fraction image is requested.
void write_mammogram_dicom(const std::filesystem::path& file, const Mammogram& image,
                           const MammogramDicom& about);

/// Reads any transfer syntax that GDCM decodes. Throws Error (input) as read_mammogram_header, and
/// for colour images, several frames or undecodable pixels.
MammogramScan read_mammogram_dicom(const std::filesystem::path& file);

}  // namespace breast
