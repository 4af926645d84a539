// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/patient_views.hpp"

#include <cmath>

#include "core/error.hpp"
#include "matching/band_edges.hpp"

namespace breast {

namespace {

std::vector<Vec2> pixels(const AlignedView& view, const std::vector<Vec2>& uv) {
  std::vector<Vec2> pixels;
  for (const Vec2& at : uv) pixels.push_back(view.pixel(at));
  return pixels;
}

// The curve, one line a stretch.
std::vector<std::vector<Vec2>> stretches(const MatchResult& result) {
  std::vector<std::vector<Vec2>> lines;
  const auto& points = result.curve.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == 0 || points[i - 1].stretch != points[i].stretch) lines.emplace_back();
    lines.back().push_back(points[i].to_uv);
  }
  return lines;
}

void draw_band(ColourPicture& picture, const AlignedView& view, const MatchResult& result,
               double width) {
  for (const BandLine& line : stretches_of(result.curve, *result.band)) {
    for (const auto& [a, b, c, d] : band_pieces(line, width))
      picture.quadrilateral({view.pixel(a), view.pixel(b), view.pixel(c), view.pixel(d)});
  }
}

std::vector<std::string> both(std::vector<std::string> first, std::vector<std::string> second) {
  for (std::string& text : second) first.push_back(std::move(text));
  return first;
}

constexpr Colour yellow{255, 214, 60}, cyan{70, 205, 255}, magenta{255, 80, 200},
    white{255, 255, 255};

}  // namespace

PatientViews::PatientViews(PatientImage from, PatientImage to, const Matcher& matcher)
    : from_(std::move(from.scan), SimulatedView(matcher, MatchEnd::from), from.nipple, from.where),
      to_(std::move(to.scan), SimulatedView(matcher, MatchEnd::to), to.nipple, to.where) {}

std::vector<Prior> PatientViews::with_alignment(std::vector<Prior> priors) const {
  const char* source = "outline's residual and pose, this image";
  priors.push_back({"alignment_from", from_.alignment().deviation_mm(), "mm", source});
  priors.push_back({"alignment_to", to_.alignment().deviation_mm(), "mm", source});
  return priors;
}

ColourPicture PatientViews::picture(const Matcher& matcher,
                                    const std::vector<MatchResult>& results) const {
  const MammogramHeader& header = to_.scan().header;
  ColourPicture picture(header.columns, header.rows, to_.scan().grey);
  const double fine = std::max(1.0, 0.25 / header.pixel_mm), bold = 1.6 * fine;  // pixels
  for (const Vec2& uv : to_.simulated_outline()) picture.disc(to_.pixel(uv), 0.5 * fine);
  picture.paint(magenta, 0.8);
  for (const auto& [width, opacity] : {std::pair{half_width_95, 0.2}, {half_width_50, 0.25}}) {
    for (const MatchResult& result : results) {
      if (result.band) draw_band(picture, to_, result, width);
    }
    picture.paint(yellow, opacity);
  }
  for (const MatchResult& result : results) {
    for (const auto& arc : result.arc) picture.line(pixels(to_, arc), fine);
  }
  picture.paint(cyan, 0.7);
  for (const MatchResult& result : results) {
    for (const auto& stretch : stretches(result)) picture.line(pixels(to_, stretch), bold);
  }
  picture.paint(yellow, 1);
  if (const auto nipple = matcher.to_landmark("nipple")) {
    const Vec2 at = to_.pixel(*nipple);
    const double arm = 2 / header.pixel_mm;
    picture.line({at - Vec2(arm, 0), at + Vec2(arm, 0)}, fine);
    picture.line({at - Vec2(0, arm), at + Vec2(0, arm)}, fine);
    picture.paint(white, 0.9);
  }
  return picture;
}

void PatientViews::report(Report& report) const {
  from_.report(report);
  to_.report(report);
}

std::vector<std::string> PatientViews::remarks() const {
  return both(from_.remarks(), to_.remarks());
}

std::vector<std::string> PatientViews::doubts() const {
  return both(from_.doubts(), to_.doubts());
}

Table curve_points_table(const Matcher& matcher, const std::vector<MatchResult>& results,
                         const PatientViews* views) {
  const std::string view = view_column(matcher.to_frame().view);
  Table table;
  table.columns = {"query", "stretch", "depth_mm", view + "_u_mm", view + "_v_mm", "deviation_mm"};
  if (views != nullptr) table.columns.insert(table.columns.end(), {view + "_x_px", view + "_y_px"});
  for (std::size_t q = 0; q < results.size(); ++q) {
    const auto& points = results[q].curve.points;
    const BandLine band =
        results[q].band ? drawn_points(results[q].curve, *results[q].band) : BandLine{};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ColumnPoint& p = points[i];
      table.rows.push_back({std::to_string(q), std::to_string(p.stretch), format_fixed(p.depth, 4),
                            format_fixed(p.to_uv.x(), 4), format_fixed(p.to_uv.y(), 4),
                            band.empty() ? "-" : format_fixed(band[i].deviation, 4)});
      if (views == nullptr) continue;
      const Vec2 pixel = views->to().pixel(p.to_uv);
      for (int k = 0; k < 2; ++k) table.rows.back().push_back(format_fixed(pixel[k], 3));
    }
  }
  return table;
}

}  // namespace breast
