// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/match_queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"

namespace breast {

const char* place_word(PlaceOrigin origin) {
  switch (origin) {
    case PlaceOrigin::truth:
      return "true";
    case PlaceOrigin::mark:
      return "marked";
    case PlaceOrigin::model:
      break;
  }
  return "model";
}

std::string MatchResult::status() const {
  if (curve.in_air()) return "air";
  if (curve.through_back) return "through_chest_wall";
  return curve.behind_image > 0 ? "behind_image" : "matched";
}

MatchResult match_query(const Matcher& matcher, const MatchQuery& query, const BandModel* band) {
  MatchResult result;
  result.query = query;
  result.curve = matcher.match(query.from_uv);
  if (result.curve.in_air()) return result;
  result.arc = matcher.nipple_arc(query.from_uv);
  result.nipple_distance = matcher.nipple_distance(query.from_uv);
  result.depth_line = matcher.nipple_depth_line(query.from_uv);
  if (band != nullptr) result.band = band->band(result.curve);
  if (!query.place) return result;
  const Vec2& place = *query.place;
  result.place_to_curve = distance_to_curve(result.curve, place);
  if (result.band) result.place_standardised = standardised_distance(*result.band, place);
  const auto from_nipple = matcher.from_landmark("nipple"),
             to_nipple = matcher.to_landmark("nipple");
  if (from_nipple && to_nipple) {
    const auto [first, second] = query.nipples.value_or(std::pair(*from_nipple, *to_nipple));
    const Vec2 behind = query.from_uv - first, there = place - second;
    result.place_to_arc = std::abs(there.norm() - behind.norm());
    result.place_to_line = std::abs(there.x() - behind.x());
  }
  MatchedCurve chord;
  chord.points = {result.curve.points.front(), result.curve.points.back()};
  chord.points.back().stretch = chord.points.front().stretch;
  result.place_to_chord = distance_to_curve(chord, place);
  return result;
}

std::vector<MatchResult> match_queries(const Matcher& matcher,
                                       const std::vector<MatchQuery>& queries,
                                       const BandModel* band) {
  std::vector<MatchResult> results(queries.size());
#pragma omp parallel for schedule(dynamic, 4)
  for (std::size_t q = 0; q < queries.size(); ++q) {
    results[q] = match_query(matcher, queries[q], band);
  }
  return results;
}

MatchQuery landmark_query(const Matcher& matcher, const std::string& name) {
  const Landmark* landmark = matcher.from().landmark(name);
  if (landmark == nullptr) {
    std::string names;
    for (const Landmark& known : matcher.from().landmarks) names += " " + known.name;
    throw input_error("the meshes have no landmark \"", name,
                      "\"; they have:", names.empty() ? " none" : names);
  }
  return {*matcher.from_landmark(name), landmark->name, matcher.to_landmark(name),
          PlaceOrigin::model};
}

std::vector<MatchQuery> grid_queries(const Matcher& matcher, int n) {
  // The image's tissue, found on a coarse raster, then spread evenly inside it.
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const ImageFrame& frame = matcher.from_frame();
  for (double v = 0.5; v < frame.height; v += 1) {
    for (double u = 0.5; u < frame.width; u += 1) {
      if (!matcher.tissue_in_from({u, v})) continue;
      low = low.cwiseMin(Vec2(u, v));
      high = high.cwiseMax(Vec2(u, v));
    }
  }
  std::vector<MatchQuery> queries;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vec2 f((i + 0.5) / n, (j + 0.5) / n);
      const Vec2 uv = low + f.cwiseProduct(high - low);
      if (matcher.tissue_in_from(uv)) queries.push_back({uv, "", std::nullopt, {}});
    }
  }
  return queries;
}

std::vector<MatchQuery> point_queries(const Table& table, const std::string& where,
                                      const std::function<Vec2(const Vec2&)>& uv_of_pixel) {
  const int u = table.column(uv_of_pixel ? "x_px" : "u_mm"),
            v = table.column(uv_of_pixel ? "y_px" : "v_mm");
  std::vector<MatchQuery> queries;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string row = where + ", row " + std::to_string(r + 1);
    const auto cell = [&](int column) {
      return parse_number(table.rows[r][std::size_t(column)], row);
    };
    MatchQuery query{{cell(u), cell(v)}, "", std::nullopt, {}};
    if (uv_of_pixel) query.from_uv = uv_of_pixel(query.from_uv);
    if (table.has("name")) query.landmark = table.cell(r, "name");
    queries.push_back(query);
  }
  if (queries.empty()) throw input_error(where, ": no points");
  return queries;
}

std::vector<MatchQuery> truth_queries(const Matcher& matcher, const Table& table,
                                      const std::string& where, int& behind) {
  const auto place = [&](std::size_t row, const ImageFrame& frame) {
    return frame.pose.project(table.point(row, view_column(frame.view) + "_"));
  };
  std::vector<MatchQuery> queries;
  std::optional<std::pair<Vec2, Vec2>> nipples;
  behind = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    if (table.cell(r, "side") != side_name(matcher.from().side)) continue;
    const std::string& name = table.cell(r, "landmark");
    const Vec2 uv = place(r, matcher.from_frame()), truth = place(r, matcher.to_frame());
    if (name == "nipple") nipples = {uv, truth};
    if (uv.x() < 0) {
      ++behind;
      continue;
    }
    queries.push_back({uv, name, truth, PlaceOrigin::truth});
  }
  for (MatchQuery& query : queries) query.nipples = nipples;
  if (queries.empty()) {
    throw input_error(where, ": no landmark of the ", side_name(matcher.from().side),
                      " breast lies in the first image");
  }
  return queries;
}

}  // namespace breast
