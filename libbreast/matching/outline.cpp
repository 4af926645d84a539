// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

constexpr double working_pixel = 0.3;  // mm; finer images are averaged to about this
constexpr double level = 0.01;         // of the breast's grey above the air
constexpr double noise_levels = 5;     // standard deviations of the air

enum class Part : std::uint8_t { unknown, air, breast };
constexpr std::array<std::array<int, 2>, 4> neighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

// The image at working resolution and what its pixels are.
struct Raster {
  int width = 0, height = 0, block = 1;
  int left = 0, top = 0;  // first pixel of the scan
  std::vector<float> grey;
  std::vector<Part> part;

  bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  std::size_t offset(int x, int y) const {
    return std::size_t(y) * std::size_t(width) + std::size_t(x);
  }
  /// Centre of a working pixel in pixels of the scan.
  Vec2 pixel(const Vec2& at) const {
    return Vec2(left, top) + block * at + Vec2::Constant(0.5 * (block - 1));
  }
};

Raster averaged(const MammogramScan& scan, const ImageField& field) {
  Raster raster;
  raster.left = field.left;
  raster.top = field.top;
  raster.block = std::max(1, int(std::lround(working_pixel / scan.header.pixel_mm)));
  raster.width = (field.right - field.left + 1) / raster.block;
  raster.height = (field.bottom - field.top + 1) / raster.block;
  raster.grey.resize(std::size_t(raster.width) * std::size_t(raster.height));
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      double sum = 0;
      for (int j = 0; j < raster.block; ++j) {
        for (int i = 0; i < raster.block; ++i) {
          sum += scan.at(field.left + x * raster.block + i, field.top + y * raster.block + j);
        }
      }
      raster.grey[raster.offset(x, y)] = float(sum / (raster.block * raster.block));
    }
  }
  raster.part.assign(raster.grey.size(), Part::unknown);
  return raster;
}

// Grey above which a pixel is not air, from the anterior border, which shows air.
float threshold_of(const Raster& raster, bool anterior_is_right) {
  const int strip = std::min(raster.width, std::max(3, raster.width / 30));
  std::vector<float> air;
  for (int y = 0; y < raster.height; ++y) {
    for (int k = 0; k < strip; ++k) {
      air.push_back(raster.grey[raster.offset(anterior_is_right ? raster.width - 1 - k : k, y)]);
    }
  }
  const auto middle = float(percentile(air, 0.5));
  for (float& value : air) value = std::abs(value - middle);
  const float noise = 1.4826f * float(percentile(std::move(air), 0.5));
  const auto bright = float(percentile(raster.grey, 0.99));
  return middle + std::max(float(level) * (bright - middle), float(noise_levels) * noise);
}

// Marks all unknown pixels on one side of the threshold that are connected with the start.
std::size_t flood(Raster& raster, std::size_t start, float threshold, bool above, Part part) {
  std::vector<std::size_t> open{start};
  raster.part[start] = part;
  std::size_t count = 0;
  while (!open.empty()) {
    const std::size_t at = open.back();
    open.pop_back();
    ++count;
    const int x = int(at % std::size_t(raster.width)), y = int(at / std::size_t(raster.width));
    for (const auto& [dx, dy] : neighbours) {
      if (!raster.inside(x + dx, y + dy)) continue;
      const std::size_t next = raster.offset(x + dx, y + dy);
      if (raster.part[next] != Part::unknown || (raster.grey[next] > threshold) != above) continue;
      raster.part[next] = part;
      open.push_back(next);
    }
  }
  return count;
}

void mark_air(Raster& raster, float threshold, bool anterior_is_right) {
  const int x = anterior_is_right ? raster.width - 1 : 0;
  for (int y = 0; y < raster.height; ++y) {
    const std::size_t at = raster.offset(x, y);
    if (raster.part[at] == Part::unknown && !(raster.grey[at] > threshold)) {
      flood(raster, at, threshold, false, Part::air);
    }
  }
}

// The largest bright region; the others (letters, markers) become unknown again.
std::size_t mark_breast(Raster& raster, float threshold) {
  std::size_t largest = 0, seed = 0;
  std::vector<Part> kept = raster.part;
  for (std::size_t at = 0; at < raster.grey.size(); ++at) {
    if (raster.part[at] != Part::unknown || !(raster.grey[at] > threshold)) continue;
    const std::size_t count = flood(raster, at, threshold, true, Part::breast);
    if (count > largest) {
      largest = count;
      seed = at;
    }
  }
  raster.part = std::move(kept);
  if (largest > 0) flood(raster, seed, threshold, true, Part::breast);
  return largest;
}

// The direction out of the breast, from its pixels nearby to those of air.
Vec2 outward(const Raster& raster, int x, int y) {
  constexpr int reach = 4;
  Vec2 sum = Vec2::Zero();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (dx * dx + dy * dy > reach * reach || !raster.inside(x + dx, y + dy)) continue;
      if (raster.part[raster.offset(x + dx, y + dy)] == Part::breast) sum -= Vec2(dx, dy);
    }
  }
  return sum.norm() > 0 ? sum.normalized() : Vec2(0, 0);
}

}  // namespace

std::vector<OutlinePoint> image_outline(const MammogramScan& scan, const ImageAxes& axes,
                                        const std::string& where) {
  Raster raster = averaged(scan, axes.field());
  if (raster.width < 20 || raster.height < 20) {
    throw input_error(where, ": ", scan.header.columns, " x ", scan.header.rows,
                      " pixels: too small for a mammogram");
  }
  const float threshold = threshold_of(raster, axes.anterior_is_right());
  mark_air(raster, threshold, axes.anterior_is_right());
  const std::size_t breast = mark_breast(raster, threshold);
  std::vector<OutlinePoint> outline;
  for (int y = 0; y < raster.height; ++y) {
    for (int x = 0; x < raster.width; ++x) {
      const std::size_t at = raster.offset(x, y);
      if (raster.part[at] != Part::breast) continue;
      for (const auto& [dx, dy] : neighbours) {
        if (!raster.inside(x + dx, y + dy)) continue;
        const std::size_t next = raster.offset(x + dx, y + dy);
        if (raster.part[next] != Part::air) continue;
        const float step = raster.grey[at] - raster.grey[next];
        const double f = step > 0 ? (raster.grey[at] - threshold) / step : 0.5;
        const Vec2 mm = axes.mm(raster.pixel(Vec2(x + f * dx, y + f * dy)));
        const Vec2 normal = axes.mm(outward(raster, x, y));  // flips as places do
        if (normal.norm() > 0) outline.push_back({mm, normal.normalized()});
      }
    }
  }
  if (breast * 50 < raster.grey.size() || outline.size() < 50) {
    throw input_error(where, ": no breast with air in front of it was found in this image");
  }
  return outline;
}

std::vector<Vec2> simulated_outline(const std::function<bool(const Vec2&)>& tissue,
                                    const ImageFrame& frame) {
  constexpr double pitch = 0.5, exact = 0.01;  // mm
  const int nu = 1 + int(frame.width / pitch), nv = 1 + int(frame.height / pitch);
  std::vector<std::uint8_t> holds(std::size_t(nu) * std::size_t(nv));
#pragma omp parallel for schedule(dynamic, 8)
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      holds[std::size_t(j) * std::size_t(nu) + std::size_t(i)] = tissue(pitch * Vec2(i, j));
    }
  }
  std::vector<Vec2> outline;
  const auto add = [&](int i, int j, int di, int dj) {
    if (i + di >= nu || j + dj >= nv) return;
    const bool here = holds[std::size_t(j) * std::size_t(nu) + std::size_t(i)],
               there = holds[std::size_t(j + dj) * std::size_t(nu) + std::size_t(i + di)];
    if (here == there) return;
    Vec2 in = pitch * Vec2(i, j), out = pitch * Vec2(i + di, j + dj);
    if (there) std::swap(in, out);
    while ((out - in).norm() > exact) {
      const Vec2 middle = 0.5 * (in + out);
      (tissue(middle) ? in : out) = middle;
    }
    outline.push_back(0.5 * (in + out));
  };
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      add(i, j, 1, 0);
      add(i, j, 0, 1);
    }
  }
  return outline;
}

}  // namespace breast
