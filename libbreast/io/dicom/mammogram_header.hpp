// SPDX-License-Identifier: GPL-3.0-or-later
// Acquisition data from the DICOM header of a mammogram.
#pragma once

#include <filesystem>

#include "projection/mammogram_scan.hpp"

namespace breast {

/// Reads modality, view, side and modifiers (see mammogram_view.hpp), Estimated Radiographic Magnification
/// Factor, Body Part Thickness (mm), Compression Force (N), Positioner Primary Angle, Patient Orientation
/// and the size of a pixel: Imager Pixel Spacing, or Pixel Spacing or that of a scanned film. The angle is
/// folded to 0-90: its sign differs between manufacturers, and 180 (the beam from below) presses the breast
/// as 0 does. Values that are impossible are ignored, with a remark. Throws Error (input) if the file is not
/// a mammogram, if its view, side or pixel spacing is missing or unknown, for pixels that are not square,
/// for a magnification view that does not state its factor, and as refuse_what_is_not_simulated.
MammogramHeader read_mammogram_header(const std::filesystem::path& file);

}  // namespace breast
