// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {

namespace {

constexpr double pixel = 0.7;  // mm
constexpr int tile_width = 500, tile_height = 360, legend_height = 34;
const cv::Scalar white_ink{255, 255, 255}, nipple_colour{255, 120, 0};
// Contours, blue first.
const cv::Vec3b wall_found{0, 220, 0}, wall_assumed{0, 140, 255}, breast_outline{0, 230, 230},
    gland_outline{60, 60, 255};

void write(cv::Mat& image, const std::string& words, const cv::Point& at) {
  cv::putText(image, words, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, white_ink, 1, cv::LINE_AA);
}

/// Where a direction points in the patient: L, P, S or R, A, I.
std::string side_of(const Vec3& direction) {
  Vec3::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return std::string(1, (direction[axis] > 0 ? "LPS" : "RAI")[axis]);
}

/// One plane: fixed index along `normal`, image columns along u, rows along v (drawn downwards, or
/// upwards when `flip`).
struct Plane {
  int normal, u, v;
  bool flip;
};

struct Painter {
  const Volume<float>& scan;
  const LabelVolume& labels;
  float white;

  Vec3 index_at(const Plane& plane, double slice, double u_mm, double v_mm) const {
    Vec3 index;
    index[plane.normal] = slice;
    index[plane.u] = u_mm / labels.grid.spacing[plane.u];
    index[plane.v] = v_mm / labels.grid.spacing[plane.v];
    return index;
  }

  /// Nearest label; -1 outside.
  int label(const Vec3& index) const {
    const int i = int(std::lround(index[0])), j = int(std::lround(index[1])),
              k = int(std::lround(index[2]));
    return labels.grid.contains(i, j, k) ? int(labels.tissue[labels.grid.offset(i, j, k)]) : -1;
  }
  double confidence(const Vec3& index) const {
    const int i = int(std::lround(index[0])), j = int(std::lround(index[1])),
              k = int(std::lround(index[2]));
    return labels.grid.contains(i, j, k) ? labels.chest_wall_confidence[labels.grid.offset(i, j, k)]
                                         : 0;
  }

  cv::Mat paint(const Plane& plane, double slice, const Vec3& centre_index) const {
    cv::Mat image(tile_height, tile_width, CV_8UC3, cv::Scalar(0, 0, 0));
    cv::Mat tissue(tile_height, tile_width, CV_8S);
    const double u0 =
        centre_index[plane.u] * labels.grid.spacing[plane.u] - 0.5 * tile_width * pixel;
    const double v0 =
        centre_index[plane.v] * labels.grid.spacing[plane.v] - 0.5 * tile_height * pixel;
    const auto place = [&](int row, int column) {
      const int r = plane.flip ? tile_height - 1 - row : row;
      return index_at(plane, slice, u0 + column * pixel, v0 + r * pixel);
    };
    for (int row = 0; row < tile_height; ++row) {
      for (int column = 0; column < tile_width; ++column) {
        const Vec3 index = place(row, column);
        const double value = sample_linear(scan, labels.grid.to_patient(index), 0);
        const auto grey = cv::saturate_cast<uchar>(255 * std::sqrt(std::max(0.0, value) / white));
        image.at<cv::Vec3b>(row, column) = {grey, grey, grey};
        tissue.at<schar>(row, column) = schar(label(index));
      }
    }
    outline(image, tissue, place);
    const auto towards = [&](int axis, double sign) {
      return side_of(sign * labels.grid.direction.col(axis));
    };
    write(image, towards(plane.u, -1), {6, tile_height / 2});
    write(image, towards(plane.v, plane.flip ? 1 : -1), {tile_width / 2, 18});
    return image;
  }

  template <class Place>
  void outline(cv::Mat& image, const cv::Mat& tissue, const Place& place) const {
    const auto inside = [](int t) { return t == 1 || t == 2 || t == 3 || t == 5; };
    for (int row = 1; row < tissue.rows; ++row) {
      for (int column = 1; column < tissue.cols; ++column) {
        const int here = tissue.at<schar>(row, column);
        for (const int other :
             {int(tissue.at<schar>(row - 1, column)), int(tissue.at<schar>(row, column - 1))}) {
          if (here == other || here < 0 || other < 0) continue;
          auto& dot = image.at<cv::Vec3b>(row, column);
          if (here == int(Tissue::muscle) || other == int(Tissue::muscle)) {
            dot = confidence(place(row, column)) > 0.5 ? wall_found : wall_assumed;
          } else if (inside(here) != inside(other)) {
            dot = breast_outline;
          } else if (here == int(Tissue::fibroglandular) || other == int(Tissue::fibroglandular)) {
            dot = gland_outline;
          }
        }
      }
    }
  }
};

void add_legend(cv::Mat strip) {
  const auto colour = [](const cv::Vec3b& c) { return cv::Scalar(c[0], c[1], c[2]); };
  const std::pair<const char*, cv::Scalar> entries[] = {
      {"breast", colour(breast_outline)},
      {"fibroglandular tissue", colour(gland_outline)},
      {"chest wall, found in the image", colour(wall_found)},
      {"chest wall, assumed (confidence below 0.5)", colour(wall_assumed)}};
  int x = 12;
  for (const auto& [words, ink] : entries) {
    cv::line(strip, {x, 17}, {x + 24, 17}, ink, 2);
    write(strip, words, {x + 32, 22});
    x += 80 + 9 * int(std::string(words).size());
  }
  cv::drawMarker(strip, {x + 12, 17}, nipple_colour, cv::MARKER_CROSS, 14, 2);
  write(strip, "nipple, at most 12 mm from the slice", {x + 32, 22});
}

}  // namespace

void write_overlay(const std::filesystem::path& file, const Volume<float>& scan,
                   const LabelVolume& labels) {
  std::vector<float> sample;
  for (std::size_t n = 0; n < scan.voxels.size(); n += 53) sample.push_back(scan.voxels[n]);
  const auto high = sample.begin() + std::ptrdiff_t(0.995 * double(sample.size() - 1));
  std::nth_element(sample.begin(), high, sample.end());
  const Painter painter{scan, labels, std::max(*high, 1e-6f)};

  const Grid& grid = labels.grid;
  Vec3 low(1e9, 1e9, 1e9), top(-1e9, -1e9, -1e9);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Tissue tissue = labels.at(i, j, k);
        if (tissue != Tissue::fat && tissue != Tissue::fibroglandular) continue;
        low = low.cwiseMin(Vec3(i, j, k));
        top = top.cwiseMax(Vec3(i, j, k));
      }
    }
  }
  if (!(top[0] >= low[0])) throw failed_error(file.string(), ": no breast to draw");
  const Vec3 centre = 0.5 * (low + top);
  constexpr int across = 4;
  const Plane planes[3] = {{2, 0, 1, false}, {0, 1, 2, true}, {1, 0, 2, true}};
  cv::Mat page(4 * tile_height + legend_height, across * tile_width, CV_8UC3, cv::Scalar(0, 0, 0));
  int tile = 0;
  for (int row = 0; row < 4; ++row) {
    const Plane& plane = planes[std::max(0, row - 1)];
    const int count = row < 2 ? 2 * across : across;
    for (int n = 0; n < across; ++n, ++tile) {
      const int number = row == 1 ? n + across : n;
      const double share = (number + 0.5) / count;
      const double slice =
          std::round(low[plane.normal] + share * (top[plane.normal] - low[plane.normal]));
      cv::Mat image = painter.paint(plane, slice, centre);
      const char* name = plane.normal == 2   ? "axial "
                         : plane.normal == 0 ? "sagittal "
                                             : "coronal ";
      write(image, name + std::to_string(int(slice)), {6, 18});
      const auto nipple = labels.landmarks.find("nipple");
      if (nipple != labels.landmarks.end()) {
        const Vec3 index = grid.to_index(nipple->second);
        if (std::abs(index[plane.normal] - slice) * grid.spacing[plane.normal] < 12) {
          const double u =
              (index[plane.u] - centre[plane.u]) * grid.spacing[plane.u] / pixel + 0.5 * tile_width;
          const double v = (index[plane.v] - centre[plane.v]) * grid.spacing[plane.v] / pixel +
                           0.5 * tile_height;
          cv::drawMarker(image, cv::Point(int(u), int(plane.flip ? tile_height - 1 - v : v)),
                         nipple_colour, cv::MARKER_CROSS, 14, 2);
        }
      }
      image.copyTo(page(cv::Rect(n * tile_width, row * tile_height, tile_width, tile_height)));
    }
  }
  add_legend(page(cv::Rect(0, 4 * tile_height, across * tile_width, legend_height)));
  std::vector<uchar> png;
  cv::imencode(".png", page, png);
  write_bytes(file, marked_png({reinterpret_cast<const char*>(png.data()), png.size()}));
}

}  // namespace breast
