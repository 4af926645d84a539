// SPDX-License-Identifier: GPL-3.0-or-later
// The working grid, and from it back to the scan's own voxels, cropped to the chosen side.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/elementary.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/grid/noise.hpp"
#include "segment/tissue/dark_parts.hpp"
#include "segment/work.hpp"

namespace breast {

namespace {

/// Voxels of `scan` over the domain's columns, from in front of the breast
/// to behind the search range.
VoxelBox side_box(const Work& coarse, const Grid& grid, Side side) {
  const Grid& working = coarse.scan.grid;
  double nearest = 1e9, deepest = 0;
  for (int k = 0; k < working.size[2]; ++k) {
    for (int i = coarse.domain.first; i <= coarse.domain.last; ++i) {
      deepest = std::max(deepest, coarse.domain.deepest.at(i, k));
      if (!std::isnan(coarse.torso.skin.at(i, k)))
        nearest = std::min(nearest, coarse.torso.skin.at(i, k));
    }
  }
  const double air = 10, behind = 8;  // mm
  const Vec3 low = grid.to_index(
      working.to_patient(Vec3(coarse.domain.first - 0.5, (nearest - air) / working.spacing[1], 0)));
  const Vec3 high = grid.to_index(working.to_patient(
      Vec3(coarse.domain.last + 0.5, (deepest + behind) / working.spacing[1], 0)));
  VoxelBox box;
  for (int d = 0; d < 2; ++d) {
    const double end = grid.size[d] - 1;
    box.first[d] = int(std::clamp(std::ceil(low[d] - 1e-6), 0.0, end));
    box.last[d] = int(std::clamp(std::floor(high[d] + 1e-6), 0.0, end));
  }
  box.last[2] = grid.size[2] - 1;
  // Air beside the body, for the surfaces' sake.
  const int beside = int(6 / grid.spacing[0]);
  if (side == Side::left) box.last[0] = std::min(box.last[0] + beside, grid.size[0] - 1);
  if (side == Side::right) box.first[0] = std::max(box.first[0] - beside, 0);
  return box;
}

/// Mean brightness of the tissue within about 4 mm.
Volume<float> local_tissue(const Work& coarse) {
  Volume<float> weight(coarse.scan.grid), value(coarse.scan.grid);
  for (std::size_t n = 0; n < weight.voxels.size(); ++n) {
    weight.voxels[n] = coarse.body.mask.voxels[n];
    value.voxels[n] = coarse.body.mask.voxels[n] ? coarse.scan.voxels[n] : 0;
  }
  weight = gaussian(std::move(weight), 4);
  value = gaussian(std::move(value), 4);
  for (std::size_t n = 0; n < weight.voxels.size(); ++n)
    value.voxels[n] /= std::max(weight.voxels[n], 1e-3f);
  return value;
}

/// Skin is about half as bright as the fat beneath: its edge against air lies near a quarter to a
/// third of the tissue's mean brightness.
constexpr float skin_edge = 0.3f;

/// Body where the working mask says so; within its last voxel or two, where the scan is above the
/// edge of skin.
Mask fine_body(const Work& coarse, const Volume<float>& scan) {
  Mask body(scan.grid);
  {
    const Volume<float> distance = resampled(coarse.skin_distance, scan.grid);
    const Volume<float> tissue = resampled(local_tissue(coarse), scan.grid);
    // The border of the working mask is that of its voxels.
    const double band = 1.2 * coarse.scan.grid.spacing[0];
    for (std::size_t n = 0; n < body.voxels.size(); ++n) {
      const float d = distance.voxels[n];
      body.voxels[n] = d < -band || (d < band && scan.voxels[n] > skin_edge * tissue.voxels[n]);
    }
  }
  return largest_component(body);
}

/// Body whose skin another scan shows: within `band` mm of the working mask's border it ends where
/// that falls below half of the brightest nearby. Skin is the bright one there: in front of it there
/// may be haze, and fat behind it may be darker than half of it.
Mask outlined_body(const Work& coarse, const Volume<float>& outline) {
  constexpr double band = 4, behind_edge = 1;  // mm
  constexpr float edge = 0.5f;
  const Volume<float> distance = resampled(coarse.skin_distance, outline.grid);
  const Volume<float> brightest = box_maximum(gaussian(outline, 0.8), band);
  Volume<float> outermost(outline.grid);  // bright voxel nearby, mm in front of -band
  for (std::size_t n = 0; n < outermost.voxels.size(); ++n) {
    const float d = distance.voxels[n];
    const bool bright = d < band && outline.voxels[n] > edge * brightest.voxels[n];
    outermost.voxels[n] = bright ? float(std::max(0.0, d + band)) : 0;
  }
  const Volume<float> around = box_maximum(outermost, band);
  Mask body(outline.grid);
  for (std::size_t n = 0; n < body.voxels.size(); ++n) {
    const double d = distance.voxels[n] + band;  // from where all is body
    body.voxels[n] = d < 0 || outermost.voxels[n] > 0 || d < around.voxels[n] - behind_edge;
  }
  return largest_component(body);
}

/// Places of a grid's voxels along an axis between those of another: the nearer end beyond.
struct Between {
  int low, high;
  double share;  ///< of the higher
};
std::vector<Between> places_along(int axis, const Grid& from, const Grid& to) {
  std::vector<Between> places;
  const double first = from.to_index(to.origin)[axis], step = to.spacing[axis] / from.spacing[axis];
  const int last = from.size[axis] - 1;
  for (int n = 0; n < to.size[axis]; ++n) {
    const double x = std::clamp(first + n * step, 0.0, double(last));
    const int low = std::min(int(x), std::max(last - 1, 0));
    places.push_back({low, std::min(low + 1, last), x - low});
  }
  return places;
}

/// Where one is not a number (at the end of the domain) the other holds.
double mixture(double low, double high, double share) {
  if (std::isnan(low)) return high;
  return std::isnan(high) ? low : low + share * (high - low);
}

/// A height field of the working grid on finer columns, less `shift`; NaN where it has none.
HeightField on_columns(const HeightField& field, const Grid& from, const Grid& to, double shift) {
  HeightField out(to.size[0], to.size[2], 0);
  const std::vector<Between> across = places_along(0, from, to), along = places_along(2, from, to);
  for (int k = 0; k < out.nz; ++k) {
    const Between& c = along[k];
    for (int i = 0; i < out.nx; ++i) {
      const Between& a = across[i];
      const double below = mixture(field.at(a.low, c.low), field.at(a.high, c.low), a.share),
                   above = mixture(field.at(a.low, c.high), field.at(a.high, c.high), a.share);
      out.at(i, k) = mixture(below, above, c.share) - shift;
    }
  }
  return out;
}

}  // namespace

Volume<float> on_working_grid(const Volume<float>& scan) {
  const Vec3 wanted(1.6, 1.6, 2.6);  // mm
  std::array<int, 3> factor{};
  for (int d = 0; d < 3; ++d)
    factor[d] = std::max(1, int(std::lround(wanted[d] / scan.grid.spacing[d])));
  return factor == std::array{1, 1, 1} ? scan : coarsened(scan, factor);
}

std::size_t side_voxels(const Work& coarse, const Grid& scanned, Side side) {
  const VoxelBox box = side_box(coarse, scanned, side);
  std::size_t count = 1;
  for (std::size_t d = 0; d < 3; ++d)
    count *= std::size_t(std::max(0, box.last[d] - box.first[d] + 1));
  return count;
}

void divide_by_bias(Work& work, const BiasField& bias) {
  const Volume<float> log_bias = resampled(bias.log_bias, work.scan.grid);
  work.brightness = work.scan;
  for (std::size_t n = 0; n < log_bias.voxels.size(); ++n)
    work.brightness.voxels[n] /= elementary::exp(log_bias.voxels[n]);
}

Volume<float> within(const Mask& body, Volume<float> brightness) {
  for (std::size_t n = 0; n < body.voxels.size(); ++n)
    if (!body.voxels[n]) brightness.voxels[n] = 0;
  return brightness;
}

namespace {

/// A wall beyond what was scanned is a guess, the worse the farther beyond.
void doubt_unseen(Work& fine) {
  if (fine.seen.voxels.empty()) return;
  const Grid& grid = fine.scan.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const double depth = fine.wall.depth.at(i, k);
      if (std::isnan(depth)) continue;
      int j = std::clamp(int(std::lround(depth / grid.spacing[1])), 0, grid.size[1] - 1);
      if (fine.seen.at(i, j, k)) continue;
      while (j > 0 && !fine.seen.at(i, j, k)) --j;
      fine.wall.confidence.at(i, k) = 0;
      fine.wall.sigma.at(i, k) = std::max(fine.wall.sigma.at(i, k), depth - j * grid.spacing[1]);
    }
  }
}

/// The body in front of the wall, without air that was taken for it; sets what is enclosed.
void clear_of_air(Work& fine) {
  const Grid& grid = fine.scan.grid;
  Mask front(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i)
        front.at(i, j, k) =
            fine.body.mask.at(i, j, k) && j * grid.spacing[1] < fine.wall.depth.at(i, k);
    }
  }
  DarkParts dark = dark_parts(fine.brightness, front);
  fine.enclosed_dark = std::move(dark.enclosed);
  if (std::none_of(dark.open.voxels.begin(), dark.open.voxels.end(), [](auto v) { return v; }))
    return;
  for (std::size_t n = 0; n < dark.open.voxels.size(); ++n)
    if (dark.open.voxels[n]) fine.body.mask.voxels[n] = 0;
  fine.body.mask = largest_component(fine.body.mask);
  fine.skin_distance = signed_distance(fine.body.mask);
}

/// Body and skin's distance as the scan shows them or, if there is one, the outline.
void find_fine_body(Work& fine, const Work& coarse, Volume<float> outline) {
  fine.body = coarse.body;
  if (outline.voxels.empty()) {
    fine.body.mask = fine_body(coarse, fine.scan);
  } else {
    fine.body.mask = outlined_body(coarse, outline);
    fine.own_distance = resampled(coarse.skin_distance, outline.grid);
    outline = {};
  }
  fine.skin_distance = signed_distance(fine.body.mask);
}

}  // namespace

Work on_scan_grid(const Work& coarse, Images images, Side side) {
  Work fine;
  const VoxelBox box = side_box(coarse, images.tissue.grid, side);
  fine.scan = cropped(images.tissue, box);
  if (images.speckled) remove_speckle(fine.scan);
  if (!images.fat_share.voxels.empty()) fine.fat_share = cropped(images.fat_share, box);
  if (!images.seen.voxels.empty()) fine.seen = cropped(images.seen, box);
  Volume<float> outline;
  if (!images.outline.voxels.empty()) outline = cropped(images.outline, box);
  images = {};
  const Grid& grid = fine.scan.grid;
  const Grid& working = coarse.scan.grid;
  find_fine_body(fine, coarse, std::move(outline));
  divide_by_bias(fine, coarse.bias);
  // Depths count from the first voxel of each grid.
  const double shift = working.to_index(grid.origin)[1] * working.spacing[1];
  fine.torso.midline = std::clamp(
      int(std::lround(grid.to_index(working.to_patient(Vec3(coarse.torso.midline, 0, 0)))[0])), 0,
      grid.size[0] - 1);
  fine.torso.one_breast = coarse.torso.one_breast;
  for (const Between& c : places_along(2, working, grid))
    fine.torso.cleft.push_back(
        mixture(coarse.torso.cleft[c.low], coarse.torso.cleft[c.high], c.share) - shift);
  fine.wall.depth = on_columns(coarse.wall.depth, working, grid, shift);
  fine.wall.confidence = on_columns(coarse.wall.confidence, working, grid, 0);
  fine.wall.sigma = on_columns(coarse.wall.sigma, working, grid, 0);
  fine.wall.muscle_ratio = coarse.wall.muscle_ratio;
  doubt_unseen(fine);
  clear_of_air(fine);
  fine.domain = wall_domain(fine.body.mask, fine.torso, side == Side::left, fine.seen);
  return fine;
}

}  // namespace breast
