// SPDX-License-Identifier: GPL-3.0-or-later
// Profile of a compression plate's rounded edge: what contact presses with and pictures show.
#pragma once

namespace breast {

/// How far a plate's rounded edge of radius r lies behind its flat, mm, at s mm beyond where it
/// starts: r − √(r²−s²). From s = r on the edge stands upright and there is no plate: infinite.
double edge_recession(double radius, double s);

}  // namespace breast
