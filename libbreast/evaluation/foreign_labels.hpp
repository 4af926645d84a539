// SPDX-License-Identifier: GPL-3.0-or-later
// Label volumes with another program's tissue codes: restriction to a region, and nipple (codes:
// image/segments.hpp).
#pragma once

#include <optional>

#include "image/segments.hpp"

namespace breast {

/// Changes breast tissue outside the region to `other`. The region, on any grid, consists of the
/// voxels with the value `code`, or with any value except 0 if `code` is 0.
void restrict_breast(LabelVolume& labels, const Volume<float>& region, int code);

/// Changes breast tissue on the other side of the body's midline (patient x, mm) to `other`: of truth
/// that shows both breasts, this leaves the one to compare with.
void restrict_to_side(LabelVolume& labels, Side side, double midline_mm);

/// Nipple of another program's volume: the point of the skin (patient mm) nearest to the centre of
/// the voxels that have the value `code` in `volume` and are breast in `labels`, which has the same
/// grid; empty if there are none.
std::optional<Vec3> skin_over_code(const Volume<float>& volume, int code,
                                   const LabelVolume& labels);

}  // namespace breast
