// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/body/slices.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace breast {

namespace {

cv::Mat slice_of(Mask& mask, int k) {
  return cv::Mat(mask.grid.size[1], mask.grid.size[0], CV_8U, &mask.at(0, 0, k));
}

/// The same to read; OpenCV has no matrix of constants.
const cv::Mat slice_of(const Mask& mask, int k) {
  return slice_of(const_cast<Mask&>(mask), k);
}

cv::Mat disc(double radius, const Grid& grid) {
  const int rx = std::max(1, int(std::lround(radius / grid.spacing[0]))),
            ry = std::max(1, int(std::lround(radius / grid.spacing[1])));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * rx + 1, 2 * ry + 1});
}

}  // namespace

void open_slices(Mask& mask, double radius) {
  for (int k = 0; k < mask.grid.size[2]; ++k) {
    cv::Mat slice = slice_of(mask, k);
    cv::morphologyEx(slice, slice, cv::MORPH_OPEN, disc(radius, mask.grid));
  }
}

Mask opening_residue(const Mask& mask, double radius, Volume<float>& height) {
  const Grid& grid = mask.grid;
  Mask residue(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    const cv::Mat slice = slice_of(mask, k);
    cv::Mat opened, distance;
    cv::morphologyEx(slice, opened, cv::MORPH_OPEN, disc(radius, grid));
    if (cv::countNonZero(opened) == 0) continue;
    cv::distanceTransform(opened == 0, distance, cv::DIST_L2, cv::DIST_MASK_5);
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        residue.at(i, j, k) = slice.at<uchar>(j, i) && !opened.at<uchar>(j, i);
        height.at(i, j, k) = float(distance.at<float>(j, i) * grid.spacing[0]);
      }
    }
  }
  return residue;
}

void close_slices(Mask& mask, double radius) {
  constexpr int border = 8;
  for (int k = 0; k < mask.grid.size[2]; ++k) {
    cv::Mat slice = slice_of(mask, k), closed;
    cv::copyMakeBorder(slice, closed, border, border, border, border, cv::BORDER_REPLICATE);
    cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, disc(radius, mask.grid));
    slice |= closed(cv::Rect(border, border, slice.cols, slice.rows));
  }
}

void erode_slices(Mask& mask, double radius) {
  for (int k = 0; k < mask.grid.size[2]; ++k) {
    cv::Mat slice = slice_of(mask, k);
    cv::erode(slice, slice, disc(radius, mask.grid), {-1, -1}, 1, cv::BORDER_REPLICATE);
  }
}

void fill_slices_from_front(Mask& mask) {
  for (int k = 0; k < mask.grid.size[2]; ++k) {
    cv::Mat slice = slice_of(mask, k);
    cv::Mat outside = slice == 0;
    for (int i = 0; i < slice.cols; ++i) {
      if (outside.at<uchar>(0, i) == 255) cv::floodFill(outside, {i, 0}, 128);
    }
    slice.setTo(1, outside != 128);
  }
}

}  // namespace breast
