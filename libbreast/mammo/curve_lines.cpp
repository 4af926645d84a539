#include "mammo/curve_lines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace breast {

namespace {

// Collects points and lines with their point data.
class Writer {
 public:
  void line(const std::string& name, int query) {
    lines_.lines.emplace_back();
    lines_.line_names.push_back(name);
    query_ = query;
  }
  void point(const Vec3& x, const Vec2& uv, double depth) {
    lines_.lines.back().push_back(int(lines_.points.size()));
    lines_.points.push_back(x);
    lines_.point_data["query"].push_back(query_);
    lines_.point_data["u_mm"].push_back(uv.x());
    lines_.point_data["v_mm"].push_back(uv.y());
    lines_.point_data["depth_mm"].push_back(depth);
  }
  void marker(const std::string& name, int query, const ViewPose& pose, const Vec2& uv) {
    line(name, query);
    point(pose.on_detector(uv), uv, 0);
  }
  PolyLines take() { return std::move(lines_); }

 private:
  PolyLines lines_;
  int query_ = 0;
};

// One line per stretch of tissue.
void add_column(Writer& writer, const std::string& name, int query, const MatchedCurve& curve,
                const std::function<Vec3(const ColumnPoint&)>& place,
                const std::function<Vec2(const ColumnPoint&)>& image) {
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ColumnPoint& point = curve.points[i];
    if (i == 0 || curve.points[i - 1].stretch != point.stretch) writer.line(name, query);
    writer.point(place(point), image(point), point.depth);
  }
}

void add_result(Writer& writer, int query, const MatchResult& result, const Matcher& matcher) {
  const ViewPose &cc = matcher.cc_frame().pose, &mlo = matcher.mlo_frame().pose;
  const MatchedCurve& curve = result.curve;
  writer.marker("point in CC", query, cc, result.query.cc_uv);
  if (result.truth) writer.marker("truth in MLO", query, mlo, *result.truth);
  const auto in_mlo = [](const ColumnPoint& p) { return p.mlo_uv; };
  const auto in_cc = [&](const ColumnPoint&) { return result.query.cc_uv; };
  add_column(
      writer, "curve", query, curve,
      [&](const ColumnPoint& p) { return mlo.on_detector(p.mlo_uv); }, in_mlo);
  add_column(
      writer, "column in CC", query, curve, [](const ColumnPoint& p) { return p.cc; }, in_cc);
  add_column(
      writer, "column in reference", query, curve, [](const ColumnPoint& p) { return p.reference; },
      in_cc);
  add_column(
      writer, "column in imaged", query, curve, [](const ColumnPoint& p) { return p.imaged; },
      in_cc);
  add_column(
      writer, "column in MLO", query, curve, [](const ColumnPoint& p) { return p.mlo; }, in_mlo);
  if (!curve.in_air()) {
    writer.line("chord", query);
    for (const ColumnPoint& end : {curve.points.front(), curve.points.back()}) {
      writer.point(mlo.on_detector(end.mlo_uv), end.mlo_uv, end.depth);
    }
  }
  for (const auto& stretch : result.arc) {
    if (stretch.size() < 2) continue;
    writer.line("arc", query);
    for (const Vec2& uv : stretch) writer.point(mlo.on_detector(uv), uv, 0);
  }
}

std::string number_or_dash(bool known, double value) {
  return known ? format_fixed(value, 4) : "-";
}

}  // namespace

std::string MatchResult::status() const {
  if (curve.in_air()) return "air";
  return curve.through_back ? "through_chest_wall" : "matched";
}

MatchResult match_query(const Matcher& matcher, const MatchQuery& query) {
  MatchResult result;
  result.query = query;
  result.curve = matcher.match(query.cc_uv);
  if (result.curve.in_air()) return result;
  result.arc = matcher.nipple_arc(query.cc_uv);
  result.nipple_distance = matcher.nipple_distance(query.cc_uv);
  if (query.landmark.empty()) return result;
  result.truth = matcher.mlo_landmark(query.landmark);
  if (!result.truth) return result;
  result.truth_to_curve = distance_to_curve(result.curve, *result.truth);
  if (const auto nipple = matcher.mlo_landmark("nipple")) {
    result.truth_to_arc = std::abs((*result.truth - *nipple).norm() - result.nipple_distance);
  }
  MatchedCurve chord;
  chord.points = {result.curve.points.front(), result.curve.points.back()};
  chord.points.back().stretch = chord.points.front().stretch;
  result.truth_to_chord = distance_to_curve(chord, *result.truth);
  return result;
}

std::vector<MatchQuery> grid_queries(const Matcher& matcher, int n) {
  // The image's tissue, found on a coarse raster, then spread evenly inside it.
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const ImageFrame& frame = matcher.cc_frame();
  for (double v = 0.5; v < frame.height; v += 1) {
    for (double u = 0.5; u < frame.width; u += 1) {
      if (!matcher.tissue_in_cc({u, v})) continue;
      low = low.cwiseMin(Vec2(u, v));
      high = high.cwiseMax(Vec2(u, v));
    }
  }
  std::vector<MatchQuery> queries;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Vec2 f((i + 0.5) / n, (j + 0.5) / n);
      const Vec2 uv = low + f.cwiseProduct(high - low);
      if (matcher.tissue_in_cc(uv)) queries.push_back({uv, ""});
    }
  }
  return queries;
}

PolyLines curve_lines(const Matcher& matcher, const std::vector<MatchResult>& results) {
  Writer writer;
  for (const char* view : {"CC", "MLO"}) {
    const bool cc = std::string(view) == "CC";
    const auto nipple = cc ? matcher.cc_landmark("nipple") : matcher.mlo_landmark("nipple");
    const ViewPose& pose = cc ? matcher.cc_frame().pose : matcher.mlo_frame().pose;
    if (nipple) writer.marker(std::string("nipple in ") + view, -1, pose, *nipple);
  }
  for (std::size_t q = 0; q < results.size(); ++q) add_result(writer, int(q), results[q], matcher);
  return writer.take();
}

Table curve_table(const std::vector<MatchResult>& results) {
  Table table;
  table.columns = {
      "query",     "landmark",  "status",           "cc_u_mm",          "cc_v_mm",
      "column_mm", "curve_mm",  "chord_mm",         "max_bend_mm",      "nipple_distance_mm",
      "true_u_mm", "true_v_mm", "true_to_curve_mm", "true_to_chord_mm", "true_to_arc_mm"};
  for (std::size_t q = 0; q < results.size(); ++q) {
    const MatchResult& r = results[q];
    const bool tissue = !r.curve.in_air(), truth = r.truth.has_value();
    const bool nipple = tissue && r.nipple_distance > 0;
    table.rows.push_back(
        {std::to_string(q), r.query.landmark.empty() ? "-" : r.query.landmark, r.status(),
         format_fixed(r.query.cc_uv.x(), 4), format_fixed(r.query.cc_uv.y(), 4),
         number_or_dash(tissue, tissue ? r.curve.points.back().depth : 0),
         number_or_dash(tissue, r.curve.length), number_or_dash(tissue, r.curve.chord),
         number_or_dash(tissue, r.curve.max_deviation), number_or_dash(nipple, r.nipple_distance),
         number_or_dash(truth, truth ? r.truth->x() : 0),
         number_or_dash(truth, truth ? r.truth->y() : 0), number_or_dash(truth, r.truth_to_curve),
         number_or_dash(truth, r.truth_to_chord), number_or_dash(truth && nipple, r.truth_to_arc)});
  }
  return table;
}

}  // namespace breast
