// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/display.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

// The contrast is steeper in dense tissue than at the skin, as with film.
constexpr double display_gamma = 2;
// Where nothing is known: an even grey between fat and dense tissue.
constexpr std::uint16_t unknown_grey = 28000;
// Where tissue is thinner than between the plates, the image fades towards the skin. A little
// compensation keeps the skin line visible; more would make it a bright seam, because rays that
// graze the skin stay in it for centimetres.
constexpr double thin_exponent = 0.2;
// Half width, in pixels, over which the border of the unknown part is softened.
constexpr int soft_border = 2;

// Between the plates the thickness is constant except at the rounded rim of the breast, which is
// the smaller part of the image.
double plate_thickness(const Mammogram& image) {
  std::vector<float> between, all;
  const int first = int(std::clamp(image.plate_edge_u / image.pixel, 0.0, double(image.width - 1)));
  for (std::size_t i = 0; i < image.thickness.size(); ++i) {
    if (!(image.thickness[i] > 0)) continue;
    all.push_back(image.thickness[i]);
    if (int(i % image.width) >= first) between.push_back(image.thickness[i]);
  }
  return percentile(between.empty() ? all : between, 0.75, 1);
}

// White is the densest tissue of the breast itself, in both views, so that the same tissue looks alike in them; muscle, which fills the
// whole column at the back of an oblique view, is then as white as that. A few bright pixels (a tumour, a fold) must not darken the rest.
double bright_end(const Mammogram& image, const std::vector<float>& shown) {
  std::vector<float> breast, all;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!(shown[i] > 0)) continue;
    all.push_back(shown[i]);
    if (image.through_back[i] == 0) breast.push_back(shown[i]);
  }
  return percentile(breast.empty() ? all : breast, 0.998, 1);
}

/// Averages over the neighbours of pixels that have both known and unknown neighbours, so that the
/// border between the two has no steps.
void soften_border(const std::vector<std::uint8_t>& unknown, HungImage& hung) {
  const std::vector<std::uint16_t> sharp = hung.grey;
  for (int row = 0; row < hung.height; ++row) {
    for (int column = 0; column < hung.width; ++column) {
      int count = 0, flagged = 0;
      long sum = 0;
      for (int r = std::max(0, row - soft_border);
           r <= std::min(hung.height - 1, row + soft_border); ++r) {
        for (int c = std::max(0, column - soft_border);
             c <= std::min(hung.width - 1, column + soft_border); ++c) {
          const std::size_t at = std::size_t(r) * hung.width + c;
          ++count;
          flagged += unknown[at];
          sum += sharp[at];
        }
      }
      if (flagged == 0 || flagged == count) continue;
      hung.grey[std::size_t(row) * hung.width + column] = std::uint16_t(sum / count);
    }
  }
}

}  // namespace

std::vector<float> compensated_path(const Mammogram& image) {
  const double between = plate_thickness(image);
  std::vector<float> shown(image.path.size(), 0);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!(image.thickness[i] > 0)) continue;
    const double ratio = between / image.thickness[i];
    shown[i] = float(image.path[i] * (ratio < 1 ? ratio : std::pow(ratio, thin_exponent)));
  }
  return shown;
}

HungImage hang(const Mammogram& image) {
  HungImage hung;
  hung.width = image.width;
  hung.height = image.height;
  const std::vector<float> shown = compensated_path(image);
  hung.window_high = bright_end(image, shown);
  hung.grey.resize(image.path.size());
  std::vector<std::uint8_t> unknown(image.path.size(), 0);  // hung
  // e_v points away from lateral (CC) and from superior (MLO) on the left
  // side, towards on the right.
  const bool left = image.side == Side::left;
  for (int row = 0; row < image.height; ++row) {
    const int v = left ? row : image.height - 1 - row;
    for (int column = 0; column < image.width; ++column) {
      const int u = left ? column : image.width - 1 - column;
      const std::size_t from = std::size_t(v) * image.width + u;
      std::uint16_t& grey = hung.grey[std::size_t(row) * image.width + column];
      if (image.blank(from)) {
        grey = unknown_grey;
        unknown[std::size_t(row) * image.width + column] = 1;
        continue;
      }
      const double value = std::clamp(shown[from] / hung.window_high, 0.0, 1.0);
      grey = std::uint16_t(std::lround(65535 * std::pow(value, display_gamma)));
    }
  }
  soften_border(unknown, hung);
  return hung;
}

}  // namespace breast
