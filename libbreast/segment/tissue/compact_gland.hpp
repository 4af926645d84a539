// SPDX-License-Identifier: GPL-3.0-or-later
// Fibroglandular tissue without fat in it, found by its edges.
#pragma once

#include "segment/tissue/bias.hpp"

namespace breast {

/// Compact fibroglandular tissue in `interior`, in blocks of about 4 mm; all zero where there is
/// none, and the mean step between fat and it. Within a large compact gland, an estimate of the
/// coil's sensitivity from fat alone sees a smooth, dim field and follows it. Its edge tells it
/// apart: the sensitivity of a coil changes by a few percent per millimetre, tissue by tens of
/// percent. Over the sensitivity that most changes agree with (coil_trend.hpp), brightness has one
/// level of fat and one of gland. `scan` is brightness as scanned, on the grid of `interior`.
DimTissue compact_gland(const Volume<float>& scan, const Mask& interior);

}  // namespace breast
