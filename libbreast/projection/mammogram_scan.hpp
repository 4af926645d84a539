// SPDX-License-Identifier: GPL-3.0-or-later
// A mammogram as a machine stored it: acquisition data and grey values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "mesh/view.hpp"

namespace breast {

/// Acquisition data from the DICOM header of a mammogram.
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
  bool bright_is_low = false;  ///< MONOCHROME1: low values are shown bright
  /// Patient directions of the image's rows (to the right) and columns (downwards), from letters
  /// such as `A\R` or `P\FL`; not normalised, zero when absent.
  Vec3 right{0, 0, 0}, down{0, 0, 0};
  /// Whether the machine states that it mirrored the image (Field of View Horizontal Flip).
  bool flipped = false;
  /// What of the header is ignored, or was found elsewhere than usual; each begins with the file's name.
  std::vector<std::string> remarks;
};

/// Pixel (0,0) is at the top left, brightness grows with attenuation.
struct MammogramScan {
  MammogramHeader header;
  std::vector<float> grey;  ///< rows from the top; 0 to 1

  float at(int column, int row) const {
    return grey[std::size_t(row) * std::size_t(header.columns) + std::size_t(column)];
  }
};

}  // namespace breast
