#include "mammo/match_queries.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"

namespace breast {

std::string MatchResult::status() const {
  if (curve.in_air()) return "air";
  if (curve.through_back) return "through_chest_wall";
  return curve.behind_image > 0 ? "behind_image" : "matched";
}

MatchResult match_query(const Matcher& matcher, const MatchQuery& query) {
  MatchResult result;
  result.query = query;
  result.curve = matcher.match(query.from_uv);
  if (result.curve.in_air()) return result;
  result.arc = matcher.nipple_arc(query.from_uv);
  result.nipple_distance = matcher.nipple_distance(query.from_uv);
  result.depth_line = matcher.nipple_depth_line(query.from_uv);
  if (!query.truth) return result;
  const Vec2& truth = *query.truth;
  result.truth_to_curve = distance_to_curve(result.curve, truth);
  if (const auto nipple = matcher.to_landmark("nipple")) {
    result.truth_to_arc = std::abs((truth - *nipple).norm() - result.nipple_distance);
  }
  if (result.depth_line) result.truth_to_line = std::abs(truth.x() - *result.depth_line);
  MatchedCurve chord;
  chord.points = {result.curve.points.front(), result.curve.points.back()};
  chord.points.back().stretch = chord.points.front().stretch;
  result.truth_to_chord = distance_to_curve(chord, truth);
  return result;
}

MatchQuery landmark_query(const Matcher& matcher, const std::string& name) {
  const auto uv = matcher.from_landmark(name);
  if (!uv) {
    std::string names;
    for (const Landmark& landmark : matcher.from().landmarks) names += " " + landmark.name;
    throw input_error("the meshes have no landmark \"", name,
                      "\"; they have:", names.empty() ? " none" : names);
  }
  return {*uv, name, matcher.to_landmark(name)};
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
      if (matcher.tissue_in_from(uv)) queries.push_back({uv, "", std::nullopt});
    }
  }
  return queries;
}

std::vector<MatchQuery> point_queries(const Table& table, const std::string& where) {
  const int u = table.column("u_mm"), v = table.column("v_mm");
  const auto named = std::find(table.columns.begin(), table.columns.end(), "name");
  std::vector<MatchQuery> queries;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string row = where + ", row " + std::to_string(r + 1);
    const auto cell = [&](int column) {
      return parse_number(table.rows[r][std::size_t(column)], row);
    };
    MatchQuery query{{cell(u), cell(v)}, "", std::nullopt};
    if (named != table.columns.end()) {
      query.landmark = table.rows[r][std::size_t(named - table.columns.begin())];
    }
    queries.push_back(query);
  }
  return queries;
}

std::vector<MatchQuery> truth_queries(const Matcher& matcher, const Table& table,
                                      const std::string& where) {
  const auto columns = [&](std::string view) {
    for (char& letter : view) letter = char(std::tolower(static_cast<unsigned char>(letter)));
    return std::array<int, 3>{table.column(view + "_x_mm"), table.column(view + "_y_mm"),
                              table.column(view + "_z_mm")};
  };
  const auto from = columns(matcher.from_frame().view), to = columns(matcher.to_frame().view);
  const int name = table.column("landmark"), side = table.column("side");
  std::vector<MatchQuery> queries;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    if (row[std::size_t(side)] != side_name(matcher.from().side)) continue;
    const auto position = [&](const std::array<int, 3>& at) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) {
        x[k] = parse_number(row[std::size_t(at[std::size_t(k)])],
                            where + ", row " + std::to_string(r + 1));
      }
      return x;
    };
    const Vec2 uv = matcher.from_frame().pose.project(position(from));
    if (uv.x() < 0) continue;
    queries.push_back({uv, row[std::size_t(name)], matcher.to_frame().pose.project(position(to))});
  }
  if (queries.empty()) {
    throw input_error(where, ": no landmark of the ", side_name(matcher.from().side),
                      " breast lies in the first image");
  }
  return queries;
}

void report_match(const MatchResult& result, Report& report) {
  const auto pair = [](const Vec2& uv) { return std::vector<double>{uv.x(), uv.y()}; };
  report.set("from_uv_mm", pair(result.query.from_uv));
  report.set("column_mm", result.curve.points.back().depth);
  report.set("curve_points", result.curve.points.size());
  report.set("curve_mm", result.curve.length);
  report.set("chord_mm", result.curve.chord);
  report.set("max_bend_mm", result.curve.max_deviation);
  report.set("reference_bend_mm", result.curve.reference_deviation);
  report.set("behind_image_mm", result.curve.behind_image);
  if (result.nipple_distance > 0) report.set("nipple_distance_mm", result.nipple_distance);
  if (!result.query.truth) return;
  report.set("true_uv_mm", pair(*result.query.truth));
  report.set("true_to_curve_mm", result.truth_to_curve);
  report.set("true_to_chord_mm", result.truth_to_chord);
  if (!result.depth_line) return;
  report.set("true_to_arc_mm", result.truth_to_arc);
  report.set("true_to_line_mm", result.truth_to_line);
}

void report_truth(const std::vector<MatchResult>& results, Report& report) {
  const auto summarise = [&](const char* name, double MatchResult::*distance) {
    std::vector<double> values;
    for (const MatchResult& result : results) {
      if (result.query.truth && !result.curve.in_air()) values.push_back(result.*distance);
    }
    if (values.empty()) return;
    std::sort(values.begin(), values.end());
    const std::string key = std::string("truth/") + name + "/";
    report.set("truth/points", values.size());
    report.set(key + "mean_mm",
               std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()));
    report.set(key + "p95_mm", values[std::size_t(std::ceil(0.95 * double(values.size()))) - 1]);
    report.set(key + "max_mm", values.back());
  };
  summarise("curve", &MatchResult::truth_to_curve);
  summarise("chord", &MatchResult::truth_to_chord);
  if (results.empty() || !results.front().depth_line) return;
  summarise("arc", &MatchResult::truth_to_arc);
  summarise("line", &MatchResult::truth_to_line);
}

}  // namespace breast
