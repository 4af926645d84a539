// SPDX-License-Identifier: GPL-3.0-or-later
// Acquisition data from the DICOM header of a mammogram.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/types.hpp"
#include "views/view.hpp"

namespace breast {

struct MammogramHeader {
  std::string patient_id;  ///< Patient ID; empty if it is not stated
  View view = View::cc;
  Side side = Side::left;
  std::optional<double> angle_deg;     ///< between the beam's line and the vertical, 0-90
  std::optional<double> thickness_mm;  ///< between the plates
  std::optional<double> force_N;
  double pixel_mm = 0;  ///< in the breast: at the detector, divided by the magnification
  /// mm at the detector per mm in the breast if the header states it, otherwise 1.
  double magnification = 1;
  int columns = 0, rows = 0;
  /// Patient directions of the image's rows (to the right) and columns (downwards), from letters
  /// such as A\R or P\FL; not normalised, zero when absent.
  Vec3 right{0, 0, 0}, down{0, 0, 0};
};

/// Reads modality, View Position and the view's modifiers, Image Laterality, Imager Pixel Spacing,
/// Estimated Radiographic Magnification Factor, Body Part Thickness (mm), Compression Force (N),
/// Positioner Primary Angle and Patient Orientation. The angle is folded to 0-90: its sign differs
/// between manufacturers, and 180 (the beam from below) presses the breast as 0 does. Throws Error
/// (input) if the file is not a mammogram, if its view, side or pixel spacing is missing or unknown,
/// for a magnification view that does not state its factor, and for what the simulated compression does
/// not show: a spot compression, and a breast with an implant.
MammogramHeader read_mammogram_header(const std::filesystem::path& file);

}  // namespace breast
