// SPDX-License-Identifier: GPL-3.0-or-later
// Warping of a scan to another shape of the breast.
#pragma once

#include "export/slicer/field.hpp"

namespace breast {

/// The values of `scan` at p + u(p) for every point p of the field's grid that lies in the body
/// (trilinear), and `air` outside it. The field maps the shape to be shown to the scan.
Volume<float> warped(const Volume<float>& scan, const DisplacementField& field, float air = 0);

/// The parts of a field as a volume: 0 extrapolated, 1 border, 2 body (FieldPart).
Volume<std::uint8_t> part_volume(const DisplacementField& field);

}  // namespace breast
