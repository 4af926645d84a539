#include "segment/body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "segment/itk_filters.hpp"

namespace breast {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double percentile(std::vector<float> values, double fraction) {
  const auto place = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Air: the two front corners (a tenth of the width, the first tenth of the depth), all slices.
double corner_air_level(const Volume<float>& scan) {
  const auto& size = scan.grid.size;
  const int width = std::max(1, size[0] / 10), depth = std::max(1, size[1] / 10);
  std::vector<float> air;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < depth; ++j) {
      for (int i = 0; i < width; ++i) {
        air.push_back(scan.at(i, j, k));
        air.push_back(scan.at(size[0] - 1 - i, j, k));
      }
    }
  }
  return percentile(std::move(air), 0.9);
}

/// Otsu's threshold of values in a histogram of 256 classes.
double otsu(const std::vector<float>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double first = *low, width = (*high - *low) / 256.0;
  std::array<double, 256> count{};
  for (const float v : values) count[std::min(255, int((v - first) / width))] += 1;
  double total = 0, sum = 0;
  for (int b = 0; b < 256; ++b) {
    total += count[b];
    sum += b * count[b];
  }
  double below = 0, below_sum = 0, best = -1, place = 0;
  for (int b = 0; b < 255; ++b) {
    below += count[b];
    below_sum += b * count[b];
    if (below == 0 || below == total) continue;
    const double gap = below_sum / below - (sum - below_sum) / (total - below);
    const double between = below * (total - below) * gap * gap;
    if (between > best) {
      best = between;
      place = b + 1;
    }
  }
  return first + width * place;
}

cv::Mat disc(double radius_mm, const Grid& grid) {
  const int rx = std::max(1, int(std::lround(radius_mm / grid.spacing[0])));
  const int ry = std::max(1, int(std::lround(radius_mm / grid.spacing[1])));
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * rx + 1, 2 * ry + 1});
}

cv::Mat slice_of(Mask& mask, int k) {
  return cv::Mat(mask.grid.size[1], mask.grid.size[0], CV_8U, &mask.at(0, 0, k));
}

void open_slices(Mask& mask) {
  for (int k = 0; k < mask.grid.size[2]; ++k) {
    cv::Mat slice = slice_of(mask, k);
    cv::morphologyEx(slice, slice, cv::MORPH_OPEN, disc(1.5, mask.grid));
  }
}

/// Closes gaps, then fills everything air cannot reach from the front.
void close_and_fill(Mask& mask) {
  for (int k = 0; k < mask.grid.size[2]; ++k) {
    cv::Mat slice = slice_of(mask, k), closed;
    const int border = 8;
    cv::copyMakeBorder(slice, closed, border, border, border, border, cv::BORDER_REPLICATE);
    cv::morphologyEx(closed, closed, cv::MORPH_CLOSE, disc(2.5, mask.grid));
    slice |= closed(cv::Rect(border, border, slice.cols, slice.rows));
    cv::Mat outside = slice == 0;
    cv::Mat front(1, slice.cols, CV_8U);
    outside.row(0).copyTo(front);
    for (int i = 0; i < slice.cols; ++i) {
      if (outside.at<uchar>(0, i) == 255) cv::floodFill(outside, {i, 0}, 128);
    }
    slice.setTo(1, outside != 128);
  }
}

/// Lungs may open to the scan's side where the field of view cuts the body: air with body in front
/// of it in its column, deeper than `from` mm behind the sternal skin, is body when there is body
/// (or the cut end of the body) behind it too.
void fill_chest(Mask& mask, const Torso& torso, double from) {
  const auto& size = mask.grid.size;
  std::size_t on_last_row = 0;
  for (int k = 0; k < size[2]; ++k) {
    for (int i = 0; i < size[0]; ++i) on_last_row += mask.at(i, size[1] - 1, k);
  }
  const bool cut = on_last_row > std::size_t(size[0]) * size[2] / 10;
  for (int k = 0; k < size[2]; ++k) {
    const int start = int((torso.cleft[k] + from) / mask.grid.spacing[1]);
    for (int i = 0; i < size[0]; ++i) {
      int last = cut ? size[1] - 1 : -1, first = 0;
      while (first < size[1] && !mask.at(i, first, k)) ++first;
      for (int j = size[1] - 1; j > last; --j) {
        if (mask.at(i, j, k)) last = j;
      }
      for (int j = std::max(first, start); j <= last; ++j) mask.at(i, j, k) = 1;
    }
  }
}

/// Peels boundary voxels that hold less than half of the tissue just inside them, so that the
/// mask's border lies at half height whatever the local coil sensitivity.
void peel_partial_voxels(Mask& mask, const Volume<float>& scan) {
  const Mask before = mask;
  const auto& size = mask.grid.size;
#pragma omp parallel for
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 1; j + 1 < size[1]; ++j) {
      for (int i = 1; i + 1 < size[0]; ++i) {
        if (!before.at(i, j, k)) continue;
        const bool border = !before.at(i - 1, j, k) || !before.at(i + 1, j, k) ||
                            !before.at(i, j - 1, k) || !before.at(i, j + 1, k);
        if (!border) continue;
        std::array<float, 49> inside;
        int count = 0;
        for (int b = std::max(j - 3, 0); b <= std::min(j + 3, size[1] - 1); ++b) {
          for (int a = std::max(i - 3, 0); a <= std::min(i + 3, size[0] - 1); ++a) {
            if (before.at(a, b, k)) inside[count++] = scan.at(a, b, k);
          }
        }
        std::nth_element(inside.begin(), inside.begin() + count / 2, inside.begin() + count);
        if (scan.at(i, j, k) < 0.5f * inside[count / 2]) mask.at(i, j, k) = 0;
      }
    }
  }
}

}  // namespace

Body find_body(const Volume<float>& scan) {
  Body body;
  body.air_level = corner_air_level(scan);
  const auto [low, high] = std::minmax_element(scan.voxels.begin(), scan.voxels.end());
  if (!(*high > *low)) throw input_error("the scan is uniform (", *low, "): no body to find");
  // A scan without air noise (n0 = 0) still needs a finite logarithm.
  const double floor = std::max(body.air_level, 1e-3 * double(*high));
  std::vector<float> logs(scan.voxels.size());
  for (std::size_t n = 0; n < logs.size(); ++n) {
    logs[n] = std::log(std::max(scan.voxels[n], 0.0f) + float(floor));
  }
  body.threshold = std::exp(otsu(logs)) - floor;
  body.mask = Mask(scan.grid);
  std::size_t count = 0;
  for (std::size_t n = 0; n < logs.size(); ++n) {
    body.mask.voxels[n] = scan.voxels[n] > body.threshold;
    count += body.mask.voxels[n];
  }
  open_slices(body.mask);
  body.mask = largest_component(body.mask);
  close_and_fill(body.mask);
  fill_chest(body.mask, find_torso(body.mask), 30);
  peel_partial_voxels(body.mask, scan);
  body.mask = largest_component(body.mask);
  const double fraction = double(count) / double(logs.size());
  if (!(fraction > 0.02 && fraction < 0.95)) {
    throw input_error("the body fills ", 100 * fraction,
                      " % of the scan (2-95 % expected): is this a ",
                      "prone breast MR with air in front?");
  }
  return body;
}

namespace {

HeightField first_body_voxel(const Mask& body) {
  HeightField skin(body.grid.size[0], body.grid.size[2], nan);
  for (int k = 0; k < skin.nz; ++k) {
    for (int j = body.grid.size[1] - 1; j >= 0; --j) {
      for (int i = 0; i < skin.nx; ++i) {
        if (body.at(i, j, k)) skin.at(i, k) = j * body.grid.spacing[1];
      }
    }
  }
  return skin;
}

/// Column about which the skin is most nearly its own mirror image, within 60 mm of the body's
/// middle.
int mirror_column(const HeightField& skin, double spacing, double deepest) {
  double sum = 0, count = 0;
  for (int k = 0; k < skin.nz; ++k) {
    for (int i = 0; i < skin.nx; ++i) {
      if (std::isnan(skin.at(i, k))) continue;
      sum += i;
      count += 1;
    }
  }
  const double middle = sum / std::max(count, 1.0);
  const int reach = int(130 / spacing), range = int(60 / spacing);
  int best = int(middle);
  double best_cost = std::numeric_limits<double>::infinity();
  for (int candidate = int(middle) - range; candidate <= int(middle) + range; ++candidate) {
    double cost = 0, pairs = 0;
    for (int k = 0; k < skin.nz; ++k) {
      for (int d = 1; d <= reach; ++d) {
        const int left = candidate - d, right = candidate + d;
        if (left < 0 || right >= skin.nx) break;
        const double a = skin.at(left, k), b = skin.at(right, k);
        cost +=
            std::min(std::abs((std::isnan(a) ? deepest : a) - (std::isnan(b) ? deepest : b)), 50.0);
        pairs += 1;
      }
    }
    if (pairs < 0.5 * reach * skin.nz) continue;
    if (cost / pairs < best_cost) {
      best_cost = cost / pairs;
      best = candidate;
    }
  }
  return std::clamp(best, 0, skin.nx - 1);
}

double median(std::vector<double> values) {
  if (values.empty()) return nan;
  const auto place = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Skin over the sternum per slice: deepest of the skin within 15 mm of the midline, median over
/// neighbouring slices.
std::vector<double> cleft_depth(const HeightField& skin, int midline, const Grid& grid) {
  std::vector<double> raw(skin.nz, nan), smooth(skin.nz, nan);
  const int half = std::max(1, int(15 / grid.spacing[0]));
  for (int k = 0; k < skin.nz; ++k) {
    for (int i = std::max(midline - half, 0); i <= std::min(midline + half, skin.nx - 1); ++i) {
      const double depth = skin.at(i, k);
      if (!std::isnan(depth) && !(depth <= raw[k])) raw[k] = depth;
    }
  }
  const int window = std::max(1, int(15 / grid.spacing[2]));
  for (int k = 0; k < skin.nz; ++k) {
    for (int reach = window; std::isnan(smooth[k]) && reach < 2 * skin.nz; reach *= 2) {
      std::vector<double> near;
      for (int c = std::max(k - reach, 0); c <= std::min(k + reach, skin.nz - 1); ++c) {
        if (!std::isnan(raw[c])) near.push_back(raw[c]);
      }
      smooth[k] = median(std::move(near));
    }
  }
  return smooth;
}

}  // namespace

Torso find_torso(const Mask& body) {
  Torso torso;
  torso.skin = first_body_voxel(body);
  torso.midline =
      mirror_column(torso.skin, body.grid.spacing[0], body.grid.size[1] * body.grid.spacing[1]);
  torso.cleft = cleft_depth(torso.skin, torso.midline, body.grid);
  if (std::isnan(torso.cleft[0]))
    throw input_error("no skin over the sternum: is the midline in the scan?");
  return torso;
}

}  // namespace breast
