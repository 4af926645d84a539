// SPDX-License-Identifier: GPL-3.0-or-later
// Mammograms as DICOM (Digital Mammography X-Ray Image Storage), through GDCM.
#pragma once

#include <filesystem>
#include <optional>

#include "dicom/mammogram_scan.hpp"
#include "projection/mammogram.hpp"

namespace breast {

/// What the image file says besides the image.
struct MammogramDicom {
  bool for_processing = false;  ///< detector signal, linear; else as displayed (display.hpp)
  std::optional<double> thickness_mm, force_N, reduction_percent;
};

/// One file, explicit little endian, 16 bits, hung as a radiologist hangs it. UIDs follow from the
/// content: the same image gives the same file. Throws Error (input) for a tissue-fraction image
/// asked for as detector signal.
void write_mammogram_dicom(const std::filesystem::path& file, const Mammogram& image,
                           const MammogramDicom& about);

/// Any transfer syntax GDCM decodes. Throws Error (input): see read_mammogram_header; colour,
/// several frames, undecodable pixels.
MammogramScan read_mammogram_dicom(const std::filesystem::path& file);

}  // namespace breast
