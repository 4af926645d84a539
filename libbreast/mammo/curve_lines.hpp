// Matched curves as named lines (curve.vtp) and as a table (curve.tsv).
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "mammo/correspondence.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// A point of the CC image asked about.
struct MatchQuery {
  Vec2 cc_uv;
  std::string landmark;  ///< name when the point is a landmark's projection, else empty
};

/// Everything found for one query.
struct MatchResult {
  MatchQuery query;
  MatchedCurve curve;
  std::vector<std::vector<Vec2>> arc;
  double nipple_distance = 0;  ///< mm, 0 without a nipple
  std::optional<Vec2> truth;   ///< the landmark's own projection in MLO
  double truth_to_curve = 0, truth_to_arc = 0, truth_to_chord = 0;  ///< mm, with `truth` only
  std::string status() const;  ///< "matched", "air", "through_chest_wall"
};
MatchResult match_query(const Matcher& matcher, const MatchQuery& query);

/// N × N points spread over the tissue of the CC image, those in air left out.
std::vector<MatchQuery> grid_queries(const Matcher& matcher, int n);

/// Lines named "curve", "arc", "chord" (on the MLO detector), "column in CC", "column in
/// reference", "column in imaged", "column in MLO"; markers "point in CC", "truth in MLO", "nipple
/// in CC", "nipple in MLO". Point data: query (number), depth_mm (columns and curve, else 0), u_mm,
/// v_mm (image position; of columns, their projection), all in the patient frame.
PolyLines curve_lines(const Matcher& matcher, const std::vector<MatchResult>& results);

/// One row per query, "-" where there is nothing to say.
Table curve_table(const std::vector<MatchResult>& results);

}  // namespace breast
