// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "page/parts.hpp"
#include "page/script_text.hpp"

namespace breast {

namespace {

constexpr double margin = 15;  // mm about the breast
constexpr std::size_t most_voxels = 3000000;

// The grid of the box along the patient's axes, coarser if the box is large.
Grid grid_about(const Box& box) {
  for (double coarser = 1;; coarser *= 1.1) {
    Grid grid;
    grid.spacing = coarser * Vec3(1, 1, 2);
    grid.origin = box.low - Vec3::Constant(margin);
    const Vec3 extent = box.high + Vec3::Constant(margin) - grid.origin;
    for (int c = 0; c < 3; ++c) grid.size[std::size_t(c)] = 1 + int(extent[c] / grid.spacing[c]);
    if (grid.voxels() <= most_voxels) return grid;
  }
}

}  // namespace

std::string scan_json(const Volume<float>& scan, const HexMesh& mesh) {
  const Grid grid = grid_about(imaged_box(mesh));
  std::vector<float> values(grid.voxels()), inside;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double value = sample_linear(scan, grid.to_patient(Vec3(i, j, k)), std::nan(""));
        values[grid.offset(i, j, k)] = float(value);
        if (std::isfinite(value)) inside.push_back(float(value));
      }
    }
  }
  if (inside.size() < grid.voxels() / 4) {
    throw input_error(
        "the scan covers ", 100 * inside.size() / grid.voxels(),
        " % of the bounding box of the imaged breast; give the scan that was segmented as --scan");
  }
  const double low = percentile(inside, 0.01), high = percentile(inside, 0.995),
               range = std::max(high - low, 1e-30);
  std::vector<std::uint8_t> grey;
  grey.reserve(values.size());
  for (const float value : values) {
    grey.push_back(std::isfinite(value) ? std::uint8_t(std::lround(
                                              255 * std::clamp((value - low) / range, 0.0, 1.0)))
                                        : 0);
  }
  return "{\"size\":" +
         numbers_json({double(grid.size[0]), double(grid.size[1]), double(grid.size[2])}) +
         ",\"spacing\":" + numbers_json({grid.spacing.x(), grid.spacing.y(), grid.spacing.z()}) +
         ",\"origin\":" + numbers_json({grid.origin.x(), grid.origin.y(), grid.origin.z()}) +
         ",\"grey\":" + script_array(grey) + "}";
}

}  // namespace breast
