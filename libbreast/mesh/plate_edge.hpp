// SPDX-License-Identifier: GPL-3.0-or-later
// Profile of a compression plate's rounded edge, used for contact and for pictures.
#pragma once

namespace breast {

/// Distance by which a plate's rounded edge of radius r lies behind its flat part, mm, at s mm
/// beyond the start of the edge: r − √(r²−s²). Infinite for s ≥ r, where there is no plate.
double edge_recession(double radius, double s);

}  // namespace breast
