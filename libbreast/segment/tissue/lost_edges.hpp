// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of brightness in the scan that the separation of fat and gland does not show.
#pragma once

#include "segment/tissue/tissue.hpp"

namespace breast {

/// Percent of the edges between blocks of 4 mm in `interior` of which the fractions of gland explain
/// less than half. Where the estimate of the bias follows gland as if it were dim fat, the corrected
/// image is even, but the scan keeps an edge too steep for a coil (`coil_trend`). 0 where there are
/// too few edges to surround a gland. `scan` is brightness as scanned, on the grid of `interior` and
/// `gland`.
double lost_edges_percent(const Volume<float>& scan, const Mask& interior,
                          const Fibroglandular& gland);

}  // namespace breast
