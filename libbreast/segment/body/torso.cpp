// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "segment/body/body.hpp"

namespace breast {

namespace {

HeightField first_body_voxel(const Mask& body) {
  HeightField skin(body.grid.size[0], body.grid.size[2], no_depth);
  for (int k = 0; k < skin.nz; ++k) {
    for (int j = body.grid.size[1] - 1; j >= 0; --j) {
      for (int i = 0; i < skin.nx; ++i) {
        if (body.at(i, j, k)) skin.at(i, k) = j * body.grid.spacing[1];
      }
    }
  }
  return skin;
}

/// A column about which the skin is nearly its own mirror image.
struct Mirror {
  int column;
  double cost;  ///< mm by which the two halves differ on average
  bool at_end;  ///< of the columns that were tried: beyond, they may differ less
};

/// The column about which the skin is most nearly its own mirror image, within 60 mm of the body's
/// middle.
Mirror mirror_column(const HeightField& skin, double spacing, double deepest) {
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
  double cost = std::numeric_limits<double>::infinity();
  for (int candidate = int(middle) - range; candidate <= int(middle) + range; ++candidate) {
    double total = 0, pairs = 0;
    for (int k = 0; k < skin.nz; ++k) {
      for (int d = 1; d <= reach; ++d) {
        const int left = candidate - d, right = candidate + d;
        if (left < 0 || right >= skin.nx) break;
        const double a = skin.at(left, k), b = skin.at(right, k);
        total +=
            std::min(std::abs((std::isnan(a) ? deepest : a) - (std::isnan(b) ? deepest : b)), 50.0);
        pairs += 1;
      }
    }
    if (pairs < 0.5 * reach * skin.nz) continue;
    if (total / pairs < cost) {
      cost = total / pairs;
      best = candidate;
    }
  }
  return {std::clamp(best, 0, skin.nx - 1), cost, std::abs(best - int(middle)) == range};
}

/// The skin as seen on a grid turned by `angle` about the middle of each slice (as rolled_grid()).
HeightField turned(const HeightField& skin, const Grid& grid, double angle) {
  HeightField out(skin.nx, skin.nz, no_depth);
  const double c = elementary::cos(angle), s = elementary::sin(angle), dx = grid.spacing[0];
  const Vec2 centre(0.5 * (grid.size[0] - 1) * dx, 0.5 * (grid.size[1] - 1) * grid.spacing[1]);
  const auto turn = [&](int i, double depth) -> Vec2 {
    const Vec2 p = Vec2(i * dx, depth) - centre;
    return Vec2(c * p[0] + s * p[1], c * p[1] - s * p[0]) + centre;
  };
  for (int k = 0; k < skin.nz; ++k) {
    for (int i = 0; i + 1 < skin.nx; ++i) {
      if (std::isnan(skin.at(i, k)) || std::isnan(skin.at(i + 1, k))) continue;
      Vec2 a = turn(i, skin.at(i, k)), b = turn(i + 1, skin.at(i + 1, k));
      if (a[0] > b[0]) std::swap(a, b);
      const int first = std::max(0, int(std::ceil(a[0] / dx))),
                last = std::min(skin.nx - 1, int(b[0] / dx));
      for (int n = first; n <= last; ++n) {
        const double share = b[0] > a[0] ? (n * dx - a[0]) / (b[0] - a[0]) : 0;
        const double depth = a[1] + share * (b[1] - a[1]);
        if (!(depth >= out.at(n, k))) out.at(n, k) = depth;
      }
    }
  }
  return out;
}

/// The skin as nearly its own mirror image as a turn of the body makes it.
struct MirrorImage {
  double angle = 0;  ///< radians; 0 where no turn makes it much more so
  int column = 0;    ///< its own mirror image about that column, turned by the angle
};

MirrorImage mirror_image(const HeightField& skin, const Grid& grid) {
  // Of the women at hand who lie straight, whose breasts are alike, a turn takes at most a sixth of the
  // difference of their halves.
  constexpr double much_less = 0.7;
  const double deepest = grid.size[1] * grid.spacing[1];
  MirrorImage found;
  const Mirror straight = mirror_column(skin, grid.spacing[0], deepest);
  found.column = straight.column;
  Mirror least = straight;
  double best = 0;
  const auto try_angle = [&](double degrees) {
    const HeightField upright = turned(skin, grid, degrees * std::numbers::pi / 180);
    const Mirror mirror = mirror_column(upright, grid.spacing[0], deepest);
    if (!mirror.at_end && mirror.cost < least.cost) least = mirror, best = degrees;
  };
  for (double degrees = -25; degrees <= 25; degrees += 5) try_angle(degrees);
  for (const double step : {2.5, 1.25}) {
    const double centre = best;
    try_angle(centre - step);
    try_angle(centre + step);
  }
  if (!straight.at_end && !(least.cost < much_less * straight.cost)) return found;
  found.angle = best * std::numbers::pi / 180;
  found.column = least.column;
  return found;
}

/// The column over the sternum: of a turned body not the one about which its skin is most nearly its own mirror
/// image as it lies, which can be the axis of one breast.
int midline_of(const HeightField& skin, const Grid& grid, const MirrorImage& image) {
  if (image.angle == 0) return image.column;
  constexpr double half = 15;  // mm
  const HeightField upright = turned(skin, grid, image.angle);
  const int reach = std::max(1, int(half / grid.spacing[0]));
  std::vector<double> sternal;
  for (int k = 0; k < skin.nz; ++k) {
    double deepest = no_depth;
    for (int i = std::max(image.column - reach, 0);
         i <= std::min(image.column + reach, skin.nx - 1); ++i)
      if (!std::isnan(upright.at(i, k)) && !(upright.at(i, k) <= deepest))
        deepest = upright.at(i, k);
    if (!std::isnan(deepest)) sternal.push_back(deepest);
  }
  const double middle = 0.5 * (grid.size[0] - 1) * grid.spacing[0],
               depth = 0.5 * (grid.size[1] - 1) * grid.spacing[1];
  const double across = image.column * grid.spacing[0] - middle,
               along = median(std::move(sternal), depth) - depth;
  const double x = elementary::cos(image.angle) * across - elementary::sin(image.angle) * along;
  return std::clamp(int(std::lround((x + middle) / grid.spacing[0])), 0, skin.nx - 1);
}

/// Skin over the sternum per slice: deepest of the skin within 15 mm of the midline, median over
/// neighbouring slices.
std::vector<double> cleft_depth(const HeightField& skin, int midline, const Grid& grid) {
  std::vector<double> raw(skin.nz, no_depth), smooth(skin.nz, no_depth);
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

/// Above the sternal notch the skin of the midline falls back to the neck, while the chest beside it
/// does not: nowhere is the sternum taken for deeper than a slope of 0.7 (35 degrees) leads to from
/// any slice. What is sought relative to it (chest wall, tissue in front of it) would otherwise be
/// sought behind the chest.
void bridge_notch(std::vector<double>& cleft, double spacing) {
  constexpr double steepest = 0.7;
  for (std::size_t k = 1; k < cleft.size(); ++k)
    cleft[k] = std::min(cleft[k], cleft[k - 1] + steepest * spacing);
  for (std::size_t k = cleft.size() - 1; k > 0; --k)
    cleft[k - 1] = std::min(cleft[k - 1], cleft[k] + steepest * spacing);
}

/// Mean depth of the skin per column over the slices (mm); `deepest` where a slice has none.
std::vector<double> mean_profile(const HeightField& skin, double deepest) {
  std::vector<double> profile(skin.nx, 0);
  for (int i = 0; i < skin.nx; ++i) {
    for (int k = 0; k < skin.nz; ++k) {
      const double depth = skin.at(i, k);
      profile[i] += (std::isnan(depth) ? deepest : depth) / skin.nz;
    }
  }
  return profile;
}

/// No second breast in view: the body is narrower than a chest, and the skin, set upright, does not come
/// forward on both sides of its mirror column (a single breast's own axis).
bool one_breast_in_view(const HeightField& skin, const Grid& grid, const MirrorImage& image) {
  constexpr double narrowest_chest = 270, valley = 8;  // mm
  const double deepest = grid.size[1] * grid.spacing[1];
  const std::vector<double> profile =
      mean_profile(image.angle == 0 ? skin : turned(skin, grid, image.angle), deepest);
  const auto columns =
      std::count_if(profile.begin(), profile.end(), [&](double p) { return p < deepest; });
  if (double(columns) * grid.spacing[0] >= narrowest_chest) return false;
  const auto mirror = profile.begin() + image.column;
  const double left = *std::min_element(profile.begin(), mirror + 1),
               right = *std::min_element(mirror, profile.end());
  return *mirror - std::max(left, right) < valley;
}

/// Deepest column between the breast's tip and the field of view's medial end.
int medial_valley(const HeightField& skin, double deepest, Side side) {
  const std::vector<double> profile = mean_profile(skin, deepest);
  const auto tip = std::min_element(profile.begin(), profile.end());
  const bool left = side == Side::left;
  const auto place = std::max_element(left ? profile.begin() : tip, left ? tip + 1 : profile.end());
  return int(place - profile.begin());
}

}  // namespace

TorsoFront find_torso(const Mask& body, Side side) {
  TorsoFront torso;
  torso.skin = first_body_voxel(body);
  const MirrorImage image = mirror_image(torso.skin, body.grid);
  torso.one_breast = one_breast_in_view(torso.skin, body.grid, image);
  torso.midline = torso.one_breast
                      ? medial_valley(torso.skin, body.grid.size[1] * body.grid.spacing[1], side)
                      : midline_of(torso.skin, body.grid, image);
  torso.cleft = cleft_depth(torso.skin, torso.midline, body.grid);
  if (std::isnan(torso.cleft[0]))
    throw input_error("no skin over the sternum: is the midline in the scan?");
  bridge_notch(torso.cleft, body.grid.spacing[2]);
  return torso;
}

double body_roll(const Mask& body) {
  const HeightField skin = first_body_voxel(body);
  const MirrorImage image = mirror_image(skin, body.grid);
  return one_breast_in_view(skin, body.grid, image) ? 0 : image.angle;
}

}  // namespace breast
