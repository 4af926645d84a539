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
  /// The true nipple in both images, with which the usual rules are then evaluated.
  std::optional<std::pair<Vec2, Vec2>> nipples = std::nullopt;
};

/// Everything found for one query.
struct MatchResult {
  MatchQuery query;
  MatchedCurve curve;
  std::vector<std::vector<Vec2>> arc;
  double nipple_distance = 0;        ///< mm, 0 without a nipple
  std::optional<double> depth_line;  ///< mm, u of the straight rule in the second image
  std::optional<Band> band;          ///< when asked for
  /// Distances from the given position, mm; only with `query.place`, and for arc and line only with
  /// a nipple.
  double place_to_curve = 0, place_to_arc = 0, place_to_line = 0, place_to_chord = 0;
  double place_standardised = 0;  ///< distance across the curve over the band's deviation
  /// A true place is known, and the point is not in air.
  bool judged() const {
    return query.place && query.origin == PlaceOrigin::truth && !curve.in_air();
  }
  /// "matched" (the whole curve lies in the second image), "air", "through_chest_wall",
  /// "behind_image" (part of the curve).
  std::string status() const;
};
MatchResult match_query(const Matcher& matcher, const MatchQuery& query,
                        const BandModel* band = nullptr);

/// All of them, on all cores; in order.
std::vector<MatchResult> match_queries(const Matcher& matcher,
                                       const std::vector<MatchQuery>& queries,
                                       const BandModel* band = nullptr);

/// Query for a landmark of the meshes: its projection, and the model's position of it in the second
/// view. Throws Error (input) listing the existing landmarks.
MatchQuery landmark_query(const Matcher& matcher, const std::string& name);
/// N × N points distributed over the tissue of the first image, without those in air.
std::vector<MatchQuery> grid_queries(const Matcher& matcher, int n);
/// Rows of a table with columns u_mm, v_mm and perhaps name; with `uv_of_pixel`, x_px and y_px.
std::vector<MatchQuery> point_queries(
    const Table& table, const std::string& where,
    const std::function<Vec2(const Vec2&)>& uv_of_pixel = nullptr);
/// Rows of a table of true positions: landmark, side and FROM_x_mm, FROM_y_mm, FROM_z_mm, TO_x_mm
/// ... with the views' names in lower case (cc_x_mm, mlo_x_mm). A landmark "nipple" serves arc and
/// line. Rows of the other breast are left out, and those whose true position lies behind the first
/// image's posterior edge, which are counted in `behind`.
std::vector<MatchQuery> truth_queries(const Matcher& matcher, const Table& table,
                                      const std::string& where, int& behind);

/// Doubts: columns through the chest wall, how much of the curves lies outside the second image,
/// points outside the first image or in air. Throws Error (input) when there is nothing to report:
/// no point, or the only one in air.
std::vector<std::string> match_doubts(const Matcher& matcher,
                                      const std::vector<MatchResult>& results);
/// Length, bends and distances of one result: keys from_uv_mm, curve_mm,
/// inside_image_percent, max_bend_mm, and by the origin of the place model_uv_mm,
/// model_to_curve_mm ..., marked_... or true_...
void report_match(const MatchResult& result, Report& report);
/// Mean, 95 % and largest distance of the truth to "curve", "arc", "line", "chord", mm, over the
/// results that have a true place: keys truth/points, truth/curve/mean_mm ..., and what part
/// of them the bands hold: truth/in_band_50_percent, truth/in_band_95_percent. Of two curves or
/// more also how far they are from straight, in the second image and as stress-free columns:
/// straightness/bend_mean_mm, straightness/reference_bend_mean_mm ... Of every status the number of
/// queries that have it: statuses/matched, statuses/behind_image ...; inside_image_percent of all
/// curves together.
void report_truth(const std::vector<MatchResult>& results, Report& report);
/// Rows mean, p95 and largest of the distances to the truth, mm; mean has the percentages in the bands.
Table truth_statistics(const std::vector<MatchResult>& results);
/// The same at the end of a curve_table, for people; the percentages stand in in_band_50 and in_band_95.
void add_statistics(const Table& statistics, Table& table);

}  // namespace breast
