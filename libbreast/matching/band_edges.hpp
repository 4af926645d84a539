// SPDX-License-Identifier: GPL-3.0-or-later
// The outline of an uncertainty band and the area that it covers, also where its curve turns sharply.
#pragma once

#include <array>
#include <vector>

#include "matching/band.hpp"

namespace breast {

/// A piece of a curve without gaps, of at least one point.
using BandLine = std::vector<BandPoint>;
/// The points of each stretch of a curve, with deviations that are smoothed along it, to draw.
std::vector<BandLine> stretches_of(const MatchedCurve& curve, const Band& band);
/// The same, one after the other: a point for each of the curve.
BandLine drawn_points(const MatchedCurve& curve, const Band& band);

/// Lines along both edges of the band of `width` standard deviations, mm in the second image; its ends are
/// open. Every place of an edge is width · deviation from the curve: about the outside of a corner an edge
/// is round, and what lies nearer to another part of the curve is no edge. A line ends where its edge does.
std::vector<std::vector<Vec2>> band_edges(const BandLine& line, double width);

/// Quadrilaterals that together cover the band, to fill.
std::vector<std::array<Vec2, 4>> band_pieces(const BandLine& line, double width);

}  // namespace breast
