// SPDX-License-Identifier: GPL-3.0-or-later
// Morphology in the axial slices of a mask.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "segment/grid/grid_ops.hpp"

namespace breast {

inline cv::Mat slice_of(Mask& mask, int k) {
  return cv::Mat(mask.grid.size[1], mask.grid.size[0], CV_8U, &mask.at(0, 0, k));
}

/// A disc of this radius (mm), of at least one voxel.
inline cv::Mat disc(double radius, const Grid& grid) {
  const int rx = std::max(1, int(std::lround(radius / grid.spacing[0]))),
            ry = std::max(1, int(std::lround(radius / grid.spacing[1])));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * rx + 1, 2 * ry + 1});
}

/// Adds gaps that a disc of this radius (mm) does not fit into, as if the slice continued beyond its border.
inline void close_gaps(cv::Mat slice, double radius, const Grid& grid) {
  cv::Mat closed;
  const int border = 8;
  cv::copyMakeBorder(slice, closed, border, border, border, border, cv::BORDER_REPLICATE);
  cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, disc(radius, grid));
  slice |= closed(cv::Rect(border, border, slice.cols, slice.rows));
}

}  // namespace breast
