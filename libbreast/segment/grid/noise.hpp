// SPDX-License-Identifier: GPL-3.0-or-later
// Noise of magnitude images, which is Rician: without a signal it has a mean, too.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// 90th percentile of the air: the two front corners (a tenth of the width, the first tenth of the
/// depth), all slices.
double corner_air_level(const Volume<float>& scan);
struct Noise {
  double deviation = 0;  ///< standard deviation, in the unit of the scan
  double share = 0;      ///< its ratio to the 90th percentile of the tissue
};
Noise noise_of(const Volume<float>& scan);
/// Whether noise is more than 4 % of bright tissue, so that single voxels of muscle and gland are as dark as air.
bool is_speckle(const Noise& noise);
/// The median of each voxel's 3 x 3 neighbours in its slice, which keeps edges where they are.
void remove_speckle(Volume<float>& scan);
/// Standard deviation of the noise if it hides what is dim: if it is more than 6 % of bright tissue
/// and a quarter of the body gives less than 2.5 times as much signal; otherwise 0.
double disturbing_noise(const Volume<float>& scan, const Noise& noise);
/// The signal without its noise of standard deviation `noise`, in the mean over about 4 mm: the
/// second moment of the signal is that of the image less that of the noise.
Volume<float> without_noise(const Volume<float>& scan, double noise);

}  // namespace breast
