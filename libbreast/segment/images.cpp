// SPDX-License-Identifier: GPL-3.0-or-later
// What was scanned, in the order and along the axes of the body.
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "image/nearest_voxel.hpp"
#include "segment/body/field_of_view.hpp"
#include "segment/contrast/dixon.hpp"
#include "segment/grid/noise.hpp"
#include "segment/work.hpp"

namespace breast {

namespace {

constexpr double least_roll = 0.06;  // radians: of people lying straight it is at most 0.02

/// Which voxels of a grid lie in the field of view and have data.
Mask seen_from(const Grid& scanned, const Mask& seen, const Grid& grid) {
  const NearestVoxel nearest(scanned);
  Mask out(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::ptrdiff_t voxel = nearest.at(grid.to_patient(Vec3(i, j, k)));
        out.at(i, j, k) =
            voxel >= 0 && (seen.voxels.empty() || seen.voxels[std::size_t(voxel)] != 0);
      }
    }
  }
  return out;
}

}  // namespace

void measure_noise(Images& images) {
  const Noise noise = noise_of(images.tissue);
  images.noise = disturbing_noise(images.tissue, noise);
  images.speckled = is_speckle(noise);
}

Images images_of(Volume<float> scan, const SegmentOptions& options) {
  Images images;
  images.tissue = in_patient_order(std::move(scan));
  images.seen = voxels_with_data(images.tissue);
  continue_beyond_data(images.tissue, images.seen);
  if (!options.fat) {
    if (options.contrast == Contrast::dixon)
      throw input_error("a Dixon scan needs its fat image beside its water image");
    measure_noise(images);
    return images;
  }
  Volume<float> fat = in_patient_order(*options.fat);
  if (fat.voxels.size() == images.seen.voxels.size()) continue_beyond_data(fat, images.seen);
  Dixon dixon = dixon_images(images.tissue, fat);
  images.tissue = std::move(dixon.sum);
  images.fat_share = std::move(dixon.fat_share);
  return images;
}

Volume<float> working_scan(const Images& images) {
  return on_working_grid(without_noise(images.tissue, images.noise));
}

Mask seen_on(const Images& images, const Grid& grid) {
  if (images.seen.voxels.empty()) return {};
  return seen_from(images.tissue.grid, images.seen, grid);
}

double stand_upright(Images& images, const Volume<float>& scanned, const Mask& body,
                     const SegmentOptions& options) {
  // Skin that a turned breast hides from the front can make the first angle half of what it should
  // be: further ones are sought on the scan turned so far.
  const auto roll_after = [&](double roll) {
    if (roll == 0) return body_roll(body);
    Volume<float> turned = on_rolled_grid(scanned, rolled_grid(scanned.grid, roll));
    end_at_front(turned, seen_from(images.tissue.grid, images.seen, turned.grid));
    return body_roll(find_body(turned, options.side, options.posture).mask);
  };
  double roll = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const double more = roll_after(roll);
    if (!(std::abs(more) > (pass == 0 ? least_roll : least_roll / 2))) break;
    roll += more;
  }
  if (roll == 0) return 0;
  const Grid upright = rolled_grid(images.tissue.grid, roll);
  images.seen = seen_from(images.tissue.grid, images.seen, upright);
  images.tissue = on_rolled_grid(images.tissue, upright);
  if (!images.fat_share.voxels.empty())
    images.fat_share = on_rolled_grid(images.fat_share, upright);
  return roll;
}

}  // namespace breast
