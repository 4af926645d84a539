// SPDX-License-Identifier: GPL-3.0-or-later
// Separable filters in mm, parallel and independent of the number of threads.
#pragma once

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Gaussian filter with the standard deviation `sigma` mm along each axis, truncated at 3 sigma;
/// values beyond the border equal those on the border.
Volume<float> gaussian(Volume<float> volume, double sigma);
/// Maximum filter: the largest value within ± half mm along each axis.
Volume<float> box_maximum(Volume<float> volume, double half);

}  // namespace breast
