// SPDX-License-Identifier: GPL-3.0-or-later
// The ITK filters that segmentation uses, applied to libbreast volumes (ITK's headers stay in one
// file).
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// 6-connected components of mask != 0, numbered from 1; 0 elsewhere.
struct Components {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> label;  ///< per voxel
};
Components components(const Mask& mask);
/// Number of voxels of every component, by the component's number; 0 for number 0.
std::vector<std::size_t> sizes(const Components& parts);
/// Largest 6-connected component of mask != 0; all zero if the mask is zero everywhere.
Mask largest_component(const Mask& mask);
/// Signed distance (mm) to the boundary of mask != 0: negative inside, positive outside.
Volume<float> signed_distance(const Mask& mask);
/// Confidence-connected region growing (mean +- multiplier * sigma, `iterations` re-estimates, seed
/// neighbourhood of radius `radius` voxels) from seeds; 1 inside the grown region.
Mask confidence_connected(Volume<float> volume, const std::vector<std::array<int, 3>>& seeds,
                          double multiplier, int radius, int iterations);

}  // namespace breast
