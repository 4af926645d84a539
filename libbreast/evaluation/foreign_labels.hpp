// SPDX-License-Identifier: GPL-3.0-or-later
// Label volumes with another program's tissue codes: restriction to a region, and nipple (codes:
// image/segments.hpp).
#pragma once

#include <optional>

#include "image/segments.hpp"

namespace breast {

/// Turns breast tissue outside the region into `other`. The region, on any grid, is where its value
/// is `code`, or any but 0 when `code` is 0.
void restrict_breast(LabelVolume& labels, const Volume<float>& region, int code);

/// Nipple of a foreign volume: the point of the skin (patient mm) nearest to the centre of
/// the voxels of `volume` that hold `code` and are breast in `labels`, which lie on the
/// same grid; empty without any.
std::optional<Vec3> skin_over_code(const Volume<float>& volume, int code,
                                   const LabelVolume& labels);

}  // namespace breast
