// SPDX-License-Identifier: GPL-3.0-or-later
// Matched curves as named lines (curve.vtp) and as a table (curve.tsv).
#pragma once

#include <vector>

#include "core/table.hpp"
#include "matching/match_queries.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Lines named "curve", "arc", "line", "chord", "band 50", "band 95" (both edges; on the second
/// view's detector), "column in FROM", "column in reference", "column in imaged", "column in TO";
/// markers "point in FROM", "nipple in FROM", "nipple in TO" and, depending on the source, "truth
/// in TO", "mark in TO" or "model's LANDMARK in TO", where FROM and TO are the views, such as CC
/// and MLO. Point data: query (number), depth_mm (columns and curve, else 0), u_mm, v_mm (image
/// position; of columns, their projection), all in the patient frame.
PolyLines curve_lines(const Matcher& matcher, const std::vector<MatchResult>& results);

/// One row per query, with "-" for missing values. Columns about the queried point begin with the
/// name of the first view (cc_u_mm); columns about its position in the second view begin with the
/// origin of that position: model_u_mm, marked_u_mm or true_u_mm.
Table curve_table(const Matcher& matcher, const std::vector<MatchResult>& results);

}  // namespace breast
