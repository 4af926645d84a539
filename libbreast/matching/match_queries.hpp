// SPDX-License-Identifier: GPL-3.0-or-later
// Queries to a Matcher, and the results for each.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/report.hpp"
#include "core/table.hpp"
#include "matching/band.hpp"
#include "matching/correspondence.hpp"

namespace breast {

/// Origin of a point's position in the second image: the landmark of the same model (which only
/// checks the mapping), the user's second mark, or a table of true positions.
enum class PlaceOrigin { model, mark, truth };
/// "model", "marked" or "true": the prefix of keys and columns about such a position.
const char* place_word(PlaceOrigin origin);

/// A point of the first image to be matched.
struct MatchQuery {
  Vec2 from_uv;
  std::string landmark;       ///< name when the point is a landmark's projection, else empty
  std::optional<Vec2> place;  ///< its position in the second image, if known
  PlaceOrigin origin = PlaceOrigin::model;
  /// The true nipple in both images, from which arc and line are then computed.
  std::optional<std::pair<Vec2, Vec2>> nipples = std::nullopt;
};

/// Everything found for one query.
struct MatchResult {
  MatchQuery query;
  MatchedCurve curve;
  std::vector<std::vector<Vec2>> arc;
  double nipple_distance = 0;        ///< mm, 0 without a nipple
  std::optional<double> depth_line;  ///< mm, u of the straight rule in the second image
  std::optional<Band> band;          ///< the band, if requested
  /// Distances from the given position, mm; only with `query.place`, and for arc and line only with
  /// a nipple.
  double place_to_curve = 0, place_to_arc = 0, place_to_line = 0, place_to_chord = 0;
  /// Distance across the curve divided by the standard deviation of the band.
  double place_standardised = 0;
  /// Whether a true position is known and the point is not in air.
  bool judged() const {
    return query.place && query.origin == PlaceOrigin::truth && !curve.in_air();
  }
  /// "matched" (the whole curve lies in the second image), "air", "through_chest_wall",
  /// "behind_image" (part of the curve).
  std::string status() const;
};
MatchResult match_query(const Matcher& matcher, const MatchQuery& query,
                        const BandModel* band = nullptr);

/// Matches all queries on all cores; the results are in the order of the queries.
std::vector<MatchResult> match_queries(const Matcher& matcher,
                                       const std::vector<MatchQuery>& queries,
                                       const BandModel* band = nullptr);

/// Query for a landmark of the meshes: its projection, and the model's position of it in the second
/// view. Throws Error (input) listing the existing landmarks.
MatchQuery landmark_query(const Matcher& matcher, const std::string& name);
/// N × N points distributed over the tissue of the first image, without those in air.
std::vector<MatchQuery> grid_queries(const Matcher& matcher, int n);
/// Queries from a table with columns u_mm, v_mm and optionally name; with `uv_of_pixel`, x_px and
/// y_px.
std::vector<MatchQuery> point_queries(
    const Table& table, const std::string& where,
    const std::function<Vec2(const Vec2&)>& uv_of_pixel = nullptr);
/// Queries from a table of true positions: landmark, side and FROM_x_mm, FROM_y_mm, FROM_z_mm,
/// TO_x_mm ... with the views' names in lower case (cc_x_mm, mlo_x_mm). A landmark "nipple" is used
/// for arc and line. Rows of the other breast are left out, and so are rows with a true position
/// behind the posterior edge of the first image, which are counted in `behind`.
std::vector<MatchQuery> truth_queries(const Matcher& matcher, const Table& table,
                                      const std::string& where, int& behind);

/// Doubts about columns through the chest wall, parts of curves outside the second image, and
/// points outside the first image or in air. Throws Error (input) if there is nothing to report: no
/// point, or a single one in air.
std::vector<std::string> match_doubts(const Matcher& matcher,
                                      const std::vector<MatchResult>& results);
/// Reports length, bends and distances of one result under the keys from_uv_mm, curve_mm,
/// inside_image_percent, max_bend_mm and, depending on the origin of the position, model_uv_mm,
/// model_to_curve_mm ..., marked_... or true_...
void report_match(const MatchResult& result, Report& report);
/// Reports, over the results with a true position, the mean, 95 % and largest distance of the truth
/// from "curve", "arc", "line" and "chord" in mm (keys truth/points, truth/curve/mean_mm ...) and
/// the percentages inside the bands (truth/in_band_50_percent, truth/in_band_95_percent). For two
/// or more curves it also reports how far they are from straight, in the second image and as
/// stress-free columns (straightness/bend_mean_mm, straightness/reference_bend_mean_mm ...), the
/// number of queries with each status (statuses/matched, statuses/behind_image ...), and
/// inside_image_percent of all curves together.
void report_truth(const std::vector<MatchResult>& results, Report& report);
/// A table of the distances from the truth, mm, with the rows mean, p95 and largest. The row mean
/// also contains the percentages of true places inside the bands.
Table truth_statistics(const std::vector<MatchResult>& results);
/// Appends these rows to a curve_table that is printed for people to read; the percentages are in
/// the columns in_band_50 and in_band_95.
void add_statistics(const Table& statistics, Table& table);

}  // namespace breast
