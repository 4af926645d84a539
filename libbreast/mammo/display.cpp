#include "mammo/display.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

// Steeper in the dense tissue than at the skin, as film is.
constexpr double display_gamma = 2;
constexpr std::uint16_t unknown_grey = 13000;

// A few bright pixels (a tumour, a fold) must not darken the rest, nor must the thicker tissue
// behind the plates: the window ends at the 99.8 % rank of the pixels that show compressed tissue.
double bright_end(const Mammogram& image) {
  std::vector<float> tissue;
  const int first = int(std::clamp(image.plate_edge_u / image.pixel, 0.0, double(image.width - 1)));
  for (std::size_t i = 0; i < image.path.size(); ++i) {
    if (image.path[i] > 0 && int(i % image.width) >= first) tissue.push_back(image.path[i]);
  }
  if (tissue.empty()) return 1;
  const auto rank = std::size_t(0.998 * double(tissue.size() - 1));
  std::nth_element(tissue.begin(), tissue.begin() + std::ptrdiff_t(rank), tissue.end());
  return tissue[rank];
}

}  // namespace

HungImage hang(const Mammogram& image) {
  HungImage hung;
  hung.width = image.width;
  hung.height = image.height;
  hung.window_high = bright_end(image);
  hung.grey.resize(image.path.size());
  // e_v points away from lateral (CC) and from superior (MLO) on the left side, towards on the
  // right.
  const bool left = image.side == Side::left;
  for (int row = 0; row < image.height; ++row) {
    const int v = left ? row : image.height - 1 - row;
    for (int column = 0; column < image.width; ++column) {
      const int u = left ? column : image.width - 1 - column;
      if (image.through_back[std::size_t(v) * image.width + u] != 0) {
        hung.grey[std::size_t(row) * image.width + column] = unknown_grey;
        continue;
      }
      const double value = image.path[std::size_t(v) * image.width + u] / hung.window_high;
      hung.grey[std::size_t(row) * image.width + column] =
          std::uint16_t(std::lround(65535 * std::pow(std::clamp(value, 0.0, 1.0), display_gamma)));
    }
  }
  return hung;
}

}  // namespace breast
