// SPDX-License-Identifier: GPL-3.0-or-later
// Profile of a compression plate's rounded edge, used for contact and for pictures.
#pragma once

namespace breast {

/// How far a plate's rounded edge of radius r lies behind its flat, mm, at s mm beyond where it
/// starts: r − √(r²−s²). For s ≥ r there is no plate: infinite.
double edge_recession(double radius, double s);

}  // namespace breast
