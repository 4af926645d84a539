// SPDX-License-Identifier: GPL-3.0-or-later
// Acquisition data from the DICOM header of a mammogram.
#pragma once

#include <filesystem>

#include "projection/mammogram_scan.hpp"

namespace breast {

/// Reads modality, View Position and the view's modifiers, Image Laterality, Imager Pixel Spacing,
/// Estimated Radiographic Magnification Factor, Body Part Thickness (mm), Compression Force (N),
/// Positioner Primary Angle and Patient Orientation. The angle is folded to 0-90: its sign differs
/// between manufacturers, and 180 (the beam from below) presses the breast as 0 does. Throws Error
/// (input) if the file is not a mammogram, if its view, side or pixel spacing is missing or unknown,
/// for a magnification view that does not state its factor, and for what the simulated compression does
/// not show: a spot compression, and a breast with an implant.
MammogramHeader read_mammogram_header(const std::filesystem::path& file);

}  // namespace breast
