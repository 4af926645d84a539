#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/table.hpp"
#include "mammo/match_queries.hpp"

namespace breast {

std::vector<std::string> match_doubts(const Matcher& matcher,
                                      const std::vector<MatchResult>& results) {
  if (results.empty()) throw input_error("no point lies on tissue; use a larger --grid");
  const ImageFrame &from = matcher.from_frame(), &to = matcher.to_frame();
  if (results.size() == 1 && results[0].curve.in_air()) {
    const Vec2& uv = results[0].query.from_uv;
    throw input_error(from.view, " point (", format_fixed(uv.x(), 2), ", ", format_fixed(uv.y(), 2),
                      ") mm lies in air; the image spans 0-", format_fixed(from.width, 1), " x 0-",
                      format_fixed(from.height, 1), " mm");
  }
  const auto count = [&](const char* status) {
    return std::count_if(results.begin(), results.end(),
                         [&](const MatchResult& result) { return result.status() == status; });
  };
  std::vector<std::string> doubts;
  const std::string all = " of " + std::to_string(results.size()) + " ";
  if (const auto back = count("through_chest_wall"); back > 0) {
    doubts.push_back(std::to_string(back) + all +
                     "columns leave the mesh through the chest wall: their curves end there though "
                     "the tissue does not");
  }
  if (const auto behind = count("behind_image"); behind > 0) {
    doubts.push_back(std::to_string(behind) + all + "curves lie partly behind the edge of the " +
                     to.view + " image: the spot may not be in it");
  }
  if (const auto air = count("air"); air > 0) {
    doubts.push_back(std::to_string(air) + all + "points lie in air");
  }
  if (!matcher.from_landmark("nipple") || !matcher.to_landmark("nipple")) {
    doubts.push_back("the meshes have no nipple landmark: no equal-distance arc and line");
  }
  return doubts;
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
  if (result.band) {
    report.set("band/area_95_mm2", result.band->area_95);
    for (const auto& [cause, deviation] : result.band->by_cause) {
      report.set("band/deviation_mm/" + cause, deviation);
    }
  }
  if (result.nipple_distance > 0) report.set("nipple_distance_mm", result.nipple_distance);
  if (!result.query.truth) return;
  report.set("true_uv_mm", pair(*result.query.truth));
  report.set("true_to_curve_mm", result.truth_to_curve);
  report.set("true_to_chord_mm", result.truth_to_chord);
  if (!result.depth_line) return;
  report.set("true_to_arc_mm", result.truth_to_arc);
  report.set("true_to_line_mm", result.truth_to_line);
}

namespace {

void report_coverage(const std::vector<MatchResult>& results, Report& report) {
  int counted = 0, inside_50 = 0, inside_95 = 0;
  for (const MatchResult& result : results) {
    if (!result.query.truth || !result.band) continue;
    ++counted;
    inside_50 += std::abs(result.truth_standardised) <= half_width_50;
    inside_95 += std::abs(result.truth_standardised) <= half_width_95;
  }
  if (counted == 0) return;
  report.set("truth/in_band_50_percent", 100.0 * inside_50 / counted);
  report.set("truth/in_band_95_percent", 100.0 * inside_95 / counted);
}

}  // namespace

void report_truth(const std::vector<MatchResult>& results, Report& report) {
  report.set("queries", results.size());
  report.set("matched",
             std::size_t(std::count_if(results.begin(), results.end(),
                                       [](const auto& r) { return r.status() == "matched"; })));
  report_coverage(results, report);
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
