// SPDX-License-Identifier: GPL-3.0-or-later
// The pixel values of a DICOM image as it stores them, before any rescaling.
#pragma once

#include <filesystem>
#include <vector>

#include "io/dicom/header.hpp"

namespace breast {

/// Throws Error (input) beginning with the file's name unless its pixels are grey values of 8 or 16 bits,
/// one per pixel, with a plausible number of bits stored.
void check_grey(const std::filesystem::path& file, const DicomHeader& header);

/// The values of these frames (from 0; of all if none is named), one after the other, each row by row: what check_grey accepts, in every
/// transfer syntax that GDCM decodes (JPEG, JPEG-LS, JPEG 2000, RLE). Native pixels are read here. Throws Error (input) for pixels
/// that cannot be decoded. GDCM may crash on damaged ones: call it in a child process (core/guarded_child.hpp)
/// if the pixels are encapsulated.
std::vector<float> stored_values(const std::filesystem::path& file, const DicomObject& object,
                                 const std::vector<int>& frames = {});

/// The values of all frames; decoded in a child process if the pixels are encapsulated.
std::vector<float> guarded_values(const std::filesystem::path& file, const DicomObject& object);

}  // namespace breast
