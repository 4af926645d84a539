// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/table.hpp"
#include "matching/match_queries.hpp"

namespace breast {

namespace {

/// mm over all curves.
struct Lengths {
  double curves = 0, inside = 0;
  double outside() const { return curves - inside; }
  double inside_percent() const { return 100 * inside / curves; }
};

Lengths lengths_of(const std::vector<MatchResult>& results) {
  Lengths lengths;
  for (const MatchResult& result : results) {
    lengths.curves += result.curve.length;
    lengths.inside += result.curve.inside_image;
  }
  return lengths;
}

}  // namespace

std::vector<std::string> match_doubts(const Matcher& matcher,
                                      const std::vector<MatchResult>& results) {
  if (results.empty()) throw input_error("no point lies on tissue; use a larger --grid");
  const ImageFrame &from = matcher.from_frame(), &to = matcher.to_frame();
  if (results.size() == 1 && results[0].curve.in_air()) {
    const Vec2& uv = results[0].query.from_uv;
    throw input_error(view_name(from.view), " point (", format_fixed(uv.x(), 2), ", ",
                      format_fixed(uv.y(), 2), ") mm lies in air; the image spans 0-",
                      format_fixed(from.width, 1), " x 0-", format_fixed(from.height, 1), " mm");
  }
  const auto count = [&](const char* status) {
    return std::count_if(results.begin(), results.end(),
                         [&](const MatchResult& result) { return result.status() == status; });
  };
  std::vector<std::string> doubts;
  const std::string all = " of " + std::to_string(results.size()) + " ";
  if (const auto back = count("through_chest_wall"); back > 0) {
    doubts.push_back(std::to_string(back) + all +
                     "columns leave the mesh through the chest wall: their curves end there "
                     "although the tissue does not");
  }
  if (const Lengths lengths = lengths_of(results); lengths.outside() > 0.01 * lengths.curves) {
    std::string which;
    if (results.size() > 1) {
      const auto partly = std::count_if(results.begin(), results.end(), [](const auto& result) {
        return result.curve.length - result.curve.inside_image > 0.01 * result.curve.length;
      });
      which = std::to_string(partly) + all + "curves leave the " + view_name(to.view) + " image: ";
    }
    doubts.push_back(message(
        which, format_fixed(lengths.outside(), 1), " of ", format_fixed(lengths.curves, 1),
        " mm of curve (", std::lround(100 - lengths.inside_percent()), " %) lie outside the ",
        view_name(to.view), " image, behind its posterior edge: the spot may not be seen there"));
  }
  const auto behind_first = std::count_if(results.begin(), results.end(), [](const auto& result) {
    return result.query.from_uv.x() < 0;
  });
  if (behind_first > 0 && results.size() == 1) {
    doubts.push_back(message("the point lies ", format_fixed(-results[0].query.from_uv.x(), 1),
                             " mm beyond the posterior edge of the ", view_name(from.view),
                             " image and is not visible in it"));
  } else if (behind_first > 0) {
    doubts.push_back(message(behind_first, all, "points lie beyond the posterior edge of the ",
                             view_name(from.view), " image and are not visible in it"));
  }
  if (const auto air = count("air"); air > 0) {
    doubts.push_back(std::to_string(air) + all + "points lie in air");
  }
  if (!matcher.from_landmark("nipple") || !matcher.to_landmark("nipple")) {
    doubts.push_back(
        "the meshes have no nipple landmark: there are no arc and line of equal "
        "distance");
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
  report.set("inside_image_mm", result.curve.inside_image);
  if (result.band) {
    report.set("band/area_95_mm2", result.band->area_95);
    for (const auto& [cause, deviation] : result.band->by_cause) {
      report.set("band/deviation_mm/" + cause, deviation);
    }
  }
  if (result.nipple_distance > 0) report.set("nipple_distance_mm", result.nipple_distance);
  if (!result.query.place) return;
  const std::string word = place_word(result.query.origin);
  report.set(word + "_uv_mm", pair(*result.query.place));
  report.set(word + "_to_curve_mm", result.place_to_curve);
  report.set(word + "_to_chord_mm", result.place_to_chord);
  if (!result.depth_line) return;
  report.set(word + "_to_arc_mm", result.place_to_arc);
  report.set(word + "_to_line_mm", result.place_to_line);
}

namespace {

struct Coverage {
  int counted = 0, in_50 = 0, in_95 = 0;
  double percent_50() const { return 100.0 * in_50 / counted; }
  double percent_95() const { return 100.0 * in_95 / counted; }
};

Coverage coverage_of(const std::vector<MatchResult>& results) {
  Coverage coverage;
  for (const MatchResult& result : results) {
    if (!result.judged() || !result.band) continue;
    ++coverage.counted;
    coverage.in_50 += std::abs(result.place_standardised) <= half_width_50;
    coverage.in_95 += std::abs(result.place_standardised) <= half_width_95;
  }
  return coverage;
}

struct Summary {
  std::size_t points = 0;
  double mean = 0, p95 = 0, largest = 0;
};

Summary summary_of(const std::vector<MatchResult>& results, double MatchResult::*distance) {
  std::vector<double> values;
  for (const MatchResult& result : results) {
    if (result.judged()) values.push_back(result.*distance);
  }
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const double n = double(values.size());
  return {values.size(), std::accumulate(values.begin(), values.end(), 0.0) / n,
          values[std::size_t(std::ceil(0.95 * n)) - 1], values.back()};
}

// Distances of the curves from straight lines, in the second view and before any compression.
void report_straightness(const std::vector<MatchResult>& results, Report& report) {
  double bend = 0, most = 0, reference = 0, reference_most = 0;
  std::size_t counted = 0;
  for (const MatchResult& result : results) {
    if (result.curve.in_air()) continue;
    ++counted;
    bend += result.curve.max_deviation;
    most = std::max(most, result.curve.max_deviation);
    reference += result.curve.reference_deviation;
    reference_most = std::max(reference_most, result.curve.reference_deviation);
  }
  if (counted < 2) return;
  report.set("straightness/curves", counted);
  report.set("straightness/bend_mean_mm", bend / double(counted));
  report.set("straightness/bend_max_mm", most);
  report.set("straightness/reference_bend_mean_mm", reference / double(counted));
  report.set("straightness/reference_bend_max_mm", reference_most);
}

bool has_nipple(const std::vector<MatchResult>& results) {
  return std::any_of(results.begin(), results.end(), [](const auto& r) { return r.depth_line; });
}

}  // namespace

void report_truth(const std::vector<MatchResult>& results, Report& report) {
  report.set("queries", results.size());
  for (const char* status : {"matched", "behind_image", "through_chest_wall", "air"}) {
    report.set(std::string("statuses/") + status,
               std::size_t(std::count_if(results.begin(), results.end(),
                                         [&](const auto& r) { return r.status() == status; })));
  }
  if (const Lengths lengths = lengths_of(results); lengths.curves > 0) {
    report.set("inside_image_percent", lengths.inside_percent());
  }
  report_straightness(results, report);
  if (const Coverage coverage = coverage_of(results); coverage.counted > 0) {
    report.set("truth/in_band_50_percent", coverage.percent_50());
    report.set("truth/in_band_95_percent", coverage.percent_95());
  }
  const auto summarise = [&](const char* name, double MatchResult::*distance) {
    const Summary summary = summary_of(results, distance);
    if (summary.points == 0) return;
    const std::string key = std::string("truth/") + name + "/";
    report.set("truth/points", summary.points);
    report.set(key + "mean_mm", summary.mean);
    report.set(key + "p95_mm", summary.p95);
    report.set(key + "max_mm", summary.largest);
  };
  summarise("curve", &MatchResult::place_to_curve);
  summarise("chord", &MatchResult::place_to_chord);
  if (!has_nipple(results)) return;
  summarise("arc", &MatchResult::place_to_arc);
  summarise("line", &MatchResult::place_to_line);
}

Table truth_statistics(const std::vector<MatchResult>& results) {
  Table table{{"statistic", "true_to_curve_mm", "true_to_chord_mm", "true_to_arc_mm",
               "true_to_line_mm", "in_band_50_percent", "in_band_95_percent"},
              {}};
  const Coverage coverage = coverage_of(results);
  const bool nipple = has_nipple(results);
  for (const auto& [name, value] : {std::pair{"mean", &Summary::mean},
                                    {"p95", &Summary::p95},
                                    {"largest", &Summary::largest}}) {
    const auto distance = [&, value = value](bool known, double MatchResult::*of) {
      return known ? format_fixed(summary_of(results, of).*value, 4) : std::string(empty_cell);
    };
    const bool band = coverage.counted > 0 && name == std::string("mean");
    table.rows.push_back({name, distance(true, &MatchResult::place_to_curve),
                          distance(true, &MatchResult::place_to_chord),
                          distance(nipple, &MatchResult::place_to_arc),
                          distance(nipple, &MatchResult::place_to_line),
                          band ? format_fixed(coverage.percent_50(), 4) : std::string(empty_cell),
                          band ? format_fixed(coverage.percent_95(), 4) : std::string(empty_cell)});
  }
  return table;
}

void add_statistics(const Table& statistics, Table& table) {
  const std::vector<std::string> columns{"landmark",       "true_to_curve_mm", "true_to_chord_mm",
                                         "true_to_arc_mm", "true_to_line_mm",  "in_band_50",
                                         "in_band_95"};
  for (const std::vector<std::string>& cells : statistics.rows) {
    std::vector<std::string> row(table.columns.size(), std::string(empty_cell));
    for (std::size_t c = 0; c < columns.size(); ++c)
      row[std::size_t(table.column(columns[c]))] = cells[c];
    table.rows.push_back(std::move(row));
  }
}

}  // namespace breast
