// SPDX-License-Identifier: GPL-3.0-or-later
// A mammogram as stored in a file: header and grey values.
#pragma once

#include <vector>

#include "dicom/mammogram_header.hpp"

namespace breast {

/// Pixel (0,0) is at the top left, brightness grows with attenuation.
struct MammogramScan {
  MammogramHeader header;
  std::vector<float> grey;  ///< rows from the top; 0 to 1

  float at(int column, int row) const {
    return grey[std::size_t(row) * std::size_t(header.columns) + std::size_t(column)];
  }
};

}  // namespace breast
