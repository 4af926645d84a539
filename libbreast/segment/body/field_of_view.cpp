// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/body/field_of_view.hpp"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "segment/grid/noise.hpp"

namespace breast {

namespace {

constexpr double least_padding = 0.005;  // of a slice
constexpr double least_filled = 0.98;    // of its convex hull, of what is a polygon
constexpr int most_corners = 8;          // a rectangle cut by another
constexpr double off_a_side = 2;         // voxels
constexpr double least_slices = 0.9;     // of those with padding, that must be polygons

/// The voxels of one slice that hold data: 255, elsewhere 0. `flat` is 255 where the slice has the darkest value of the scan.
cv::Mat data_of(const cv::Mat& flat) {
  // Single voxels of noise may be as dark as the padding.
  cv::Mat padding, framed, parts;
  cv::copyMakeBorder(flat, framed, 2, 2, 2, 2, cv::BORDER_REPLICATE);
  cv::morphologyEx(framed, framed, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  padding = framed(cv::Rect(2, 2, flat.cols, flat.rows));
  const int count = cv::connectedComponents(padding, parts, 4);
  std::vector<char> at_border(std::size_t(count), 0);
  const auto mark = [&](int row, int column) { at_border[parts.at<int>(row, column)] = 1; };
  for (int i = 0; i < flat.cols; ++i) mark(0, i), mark(flat.rows - 1, i);
  for (int j = 0; j < flat.rows; ++j) mark(j, 0), mark(j, flat.cols - 1);
  at_border[0] = 0;
  cv::Mat data(flat.rows, flat.cols, CV_8U);
  for (int j = 0; j < flat.rows; ++j)
    for (int i = 0; i < flat.cols; ++i)
      data.at<uchar>(j, i) = at_border[parts.at<int>(j, i)] ? 0 : 255;
  return data;
}

/// True if the data fill a convex polygon of few corners.
bool is_polygon(const cv::Mat& data) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(data.clone(), outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  if (outlines.empty()) return true;  // nothing of this slice was scanned
  const auto& outline =
      *std::max_element(outlines.begin(), outlines.end(),
                        [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<cv::Point> hull, corners;
  cv::convexHull(outline, hull);
  cv::approxPolyDP(hull, corners, off_a_side, true);
  return corners.size() <= most_corners &&
         cv::contourArea(outline) >= least_filled * cv::contourArea(corners);
}

}  // namespace

Mask voxels_with_data(const Volume<float>& scan) {
  // Slices are small, and no thread of OpenCV may be left when a file is written by a fork of the process.
  cv::setNumThreads(1);
  const auto& size = scan.grid.size;
  const float darkest = *std::min_element(scan.voxels.begin(), scan.voxels.end());
  Mask seen(scan.grid);
  cv::Mat ever(size[1], size[0], CV_8U, cv::Scalar(0));
  int padded = 0, polygons = 0;
  for (int k = 0; k < size[2]; ++k) {
    const cv::Mat slice(size[1], size[0], CV_32F, const_cast<float*>(&scan.at(0, 0, k)));
    const cv::Mat data = data_of(slice == darkest);
    ever |= data;
    if (double(cv::countNonZero(data)) < (1 - least_padding) * double(data.total())) {
      ++padded;
      polygons += is_polygon(data);
    }
    cv::Mat(size[1], size[0], CV_8U, &seen.at(0, 0, k)).setTo(1, data);
  }
  if (padded == 0 || polygons < least_slices * padded || !is_polygon(ever)) return {};
  return seen;
}

void continue_beyond_data(Volume<float>& scan, const Mask& seen) {
  if (seen.voxels.empty()) return;
  const auto& size = scan.grid.size;
#pragma omp parallel for
  for (int k = 0; k < size[2]; ++k) {
    cv::Mat distance, nearest;
    const cv::Mat data(size[1], size[0], CV_8U, const_cast<std::uint8_t*>(&seen.at(0, 0, k)));
    if (cv::countNonZero(data) == 0) continue;
    cv::distanceTransform(data == 0, distance, nearest, cv::DIST_L2, cv::DIST_MASK_5,
                          cv::DIST_LABEL_PIXEL);
    std::vector<float> value(data.total() + 1, 0);
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        if (data.at<uchar>(j, i)) value[nearest.at<int>(j, i)] = scan.at(i, j, k);
    for (int j = 0; j < size[1]; ++j)
      for (int i = 0; i < size[0]; ++i)
        if (!data.at<uchar>(j, i)) scan.at(i, j, k) = value[nearest.at<int>(j, i)];
  }
}

void end_at_front(Volume<float>& scan, const Mask& seen) {
  if (seen.voxels.empty()) return;
  const auto& size = scan.grid.size;
  const float air = float(corner_air_level(scan));
  for (int k = 0; k < size[2]; ++k) {
    for (int i = 0; i < size[0]; ++i) {
      int first = 0;
      while (first < size[1] && !seen.at(i, first, k)) ++first;
      if (first == size[1]) continue;  // beside the view
      for (int j = 0; j < first; ++j) scan.at(i, j, k) = std::min(scan.at(i, j, k), air);
    }
  }
}

}  // namespace breast
