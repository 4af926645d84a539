// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/curve_lines.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "matching/band_edges.hpp"

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

// Both edges of the band of each stretch.
void add_band(Writer& writer, const std::string& name, int query, const MatchResult& result,
              double width, const ViewPose& to) {
  for (const BandLine& line : stretches_of(result.curve, *result.band)) {
    for (const std::vector<Vec2>& edge : band_edges(line, width)) {
      writer.line(name, query);
      for (const Vec2& uv : edge) writer.point(to.on_detector(uv), uv, 0);
    }
  }
}

// "truth in MLO", "mark in MLO", "model's tumour in MLO".
std::string place_name(const MatchQuery& query, const std::string& view) {
  switch (query.origin) {
    case PlaceOrigin::truth:
      return "truth in " + view;
    case PlaceOrigin::mark:
      return "mark in " + view;
    case PlaceOrigin::model:
      break;
  }
  return "model's " + query.landmark + " in " + view;
}

void add_result(Writer& writer, int query, const MatchResult& result, const Matcher& matcher) {
  const ViewPose &from = matcher.from_frame().pose, &to = matcher.to_frame().pose;
  const std::string first = view_name(matcher.from_frame().view),
                    second = view_name(matcher.to_frame().view);
  const MatchedCurve& curve = result.curve;
  writer.marker("point in " + first, query, from, result.query.from_uv);
  if (result.query.place) {
    writer.marker(place_name(result.query, second), query, to, *result.query.place);
  }
  const auto in_to = [](const ColumnPoint& p) { return p.to_uv; };
  const auto in_from = [&](const ColumnPoint&) { return result.query.from_uv; };
  add_column(
      writer, "curve", query, curve, [&](const ColumnPoint& p) { return to.on_detector(p.to_uv); },
      in_to);
  add_column(
      writer, "column in " + first, query, curve, [](const ColumnPoint& p) { return p.from; },
      in_from);
  add_column(
      writer, "column in reference", query, curve, [](const ColumnPoint& p) { return p.reference; },
      in_from);
  add_column(
      writer, "column in imaged", query, curve, [](const ColumnPoint& p) { return p.imaged; },
      in_from);
  add_column(
      writer, "column in " + second, query, curve, [](const ColumnPoint& p) { return p.to; },
      in_to);
  if (result.band) {
    add_band(writer, "band 50", query, result, half_width_50, to);
    add_band(writer, "band 95", query, result, half_width_95, to);
  }
  if (!curve.in_air()) {
    writer.line("chord", query);
    for (const ColumnPoint& end : {curve.points.front(), curve.points.back()}) {
      writer.point(to.on_detector(end.to_uv), end.to_uv, end.depth);
    }
  }
  for (const auto& stretch : result.arc) {
    if (stretch.size() < 2) continue;
    writer.line("arc", query);
    for (const Vec2& uv : stretch) writer.point(to.on_detector(uv), uv, 0);
  }
  if (result.depth_line && *result.depth_line >= 0) {
    writer.line("line", query);
    for (const double v : {0.0, matcher.to_frame().height}) {
      const Vec2 uv(*result.depth_line, v);
      writer.point(to.on_detector(uv), uv, 0);
    }
  }
}

std::string number_or_dash(bool known, double value) {
  return known ? format_fixed(value, 4) : "-";
}

}  // namespace

PolyLines curve_lines(const Matcher& matcher, const std::vector<MatchResult>& results) {
  Writer writer;
  const auto nipple = [&](const ImageFrame& frame, const std::optional<Vec2>& at) {
    if (at) writer.marker("nipple in " + view_name(frame.view), -1, frame.pose, *at);
  };
  nipple(matcher.from_frame(), matcher.from_landmark("nipple"));
  nipple(matcher.to_frame(), matcher.to_landmark("nipple"));
  for (std::size_t q = 0; q < results.size(); ++q) add_result(writer, int(q), results[q], matcher);
  return writer.take();
}

Table curve_table(const Matcher& matcher, const std::vector<MatchResult>& results) {
  const std::string view = view_column(matcher.from_frame().view);
  const auto known = std::find_if(results.begin(), results.end(),
                                  [](const auto& r) { return r.query.place.has_value(); });
  const std::string whose =
      place_word(known == results.end() ? PlaceOrigin::model : known->query.origin);
  Table table;
  table.columns = {"query",
                   "landmark",
                   "status",
                   view + "_u_mm",
                   view + "_v_mm",
                   "column_mm",
                   "curve_mm",
                   "chord_mm",
                   "max_bend_mm",
                   "reference_bend_mm",
                   "behind_image_mm",
                   "nipple_distance_mm",
                   whose + "_u_mm",
                   whose + "_v_mm",
                   whose + "_to_curve_mm",
                   whose + "_to_chord_mm",
                   whose + "_to_arc_mm",
                   whose + "_to_line_mm",
                   "band_95_area_mm2",
                   whose + "_over_deviation",
                   "in_band_50",
                   "in_band_95",
                   "inside_image_percent"};
  for (std::size_t q = 0; q < results.size(); ++q) {
    const MatchResult& r = results[q];
    const bool tissue = !r.curve.in_air(), placed = tissue && r.query.place.has_value();
    const bool nipple = tissue && r.nipple_distance > 0;
    const auto in_band = [&](double width) -> std::string {
      if (!r.judged() || !r.band) return "-";  // a place of the model itself proves no band
      return std::abs(r.place_standardised) <= width ? "1" : "0";
    };
    table.rows.push_back(
        {std::to_string(q),
         r.query.landmark.empty() ? "-" : r.query.landmark,
         r.status(),
         format_fixed(r.query.from_uv.x(), 4),
         format_fixed(r.query.from_uv.y(), 4),
         number_or_dash(tissue, tissue ? r.curve.points.back().depth : 0),
         number_or_dash(tissue, r.curve.length),
         number_or_dash(tissue, r.curve.chord),
         number_or_dash(tissue, r.curve.max_deviation),
         number_or_dash(tissue, r.curve.reference_deviation),
         number_or_dash(tissue, r.curve.behind_image),
         number_or_dash(nipple, r.nipple_distance),
         number_or_dash(placed, placed ? r.query.place->x() : 0),
         number_or_dash(placed, placed ? r.query.place->y() : 0),
         number_or_dash(placed, r.place_to_curve),
         number_or_dash(placed, r.place_to_chord),
         number_or_dash(placed && nipple, r.place_to_arc),
         number_or_dash(placed && nipple, r.place_to_line),
         number_or_dash(r.band.has_value(), r.band ? r.band->area_95 : 0),
         number_or_dash(placed && r.band, r.place_standardised),
         in_band(half_width_50),
         in_band(half_width_95),
         number_or_dash(r.curve.length > 0, 100 * r.curve.inside_image / r.curve.length)});
  }
  return table;
}

}  // namespace breast
