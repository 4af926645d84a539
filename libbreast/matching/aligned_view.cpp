// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/aligned_view.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

constexpr double finest_hung = 0.25;  // mm

const HexMesh& checked_mesh(const MammogramScan& scan, const Matcher& matcher, MatchEnd end,
                            const std::string& where) {
  const HexMesh& mesh = end == MatchEnd::from ? matcher.from() : matcher.to();
  require_view(scan.header, mesh, where);
  return mesh;
}

Alignment aligned(const MammogramScan& scan, const ImageAxes& axes, const ImageFrame& frame,
                  double edge_radius, const std::vector<Vec2>& simulated,
                  const std::optional<Vec2>& landmark, const std::optional<Vec2>& mark,
                  const std::string& where) {
  AlignmentData data;
  data.simulated = simulated;
  data.real = image_outline(scan, axes, where);
  data.plate_edge_u = frame.plate_edge_u - edge_radius;
  if (mark && !landmark) throw input_error(where, ": a nipple is marked, but the mesh has none");
  if (mark) data.nipple = {*landmark, axes.mm(*mark)};
  const Alignment found = align_outlines(data, axes, where);
  check_upright(data, axes, found, where);
  return found;
}

}  // namespace

void require_view(const MammogramHeader& header, const HexMesh& compressed,
                  const std::string& where) {
  if (header.side != compressed.side) {
    throw input_error(where, ": a mammogram of the ", side_name(header.side),
                      " breast, but the meshes are of the ", side_name(compressed.side));
  }
  if (header.view != compressed.contact->view) {
    throw input_error(where, ": shows ", view_name(header.view), ", the mesh ",
                      view_name(compressed.contact->view));
  }
}

AlignedView::AlignedView(MammogramScan scan, const Matcher& matcher, MatchEnd end,
                         const std::optional<Vec2>& nipple, const std::string& where)
    : scan_(std::move(scan)),
      compression_(*checked_mesh(scan_, matcher, end, where).contact),
      where_(where),
      axes_(scan_.header,
            end == MatchEnd::from ? matcher.from_frame().pose : matcher.to_frame().pose, where) {
  const bool from = end == MatchEnd::from;
  const ImageFrame& frame = from ? matcher.from_frame() : matcher.to_frame();
  simulated_ = breast::simulated_outline(
      [&](const Vec2& uv) { return from ? matcher.tissue_in_from(uv) : matcher.tissue_in_to(uv); },
      frame);
  const double radius = compression_.plates.empty() ? 0 : compression_.plates.front().edge_radius;
  const std::optional<Vec2> landmark =
      from ? matcher.from_landmark("nipple") : matcher.to_landmark("nipple");
  alignment_ = aligned(scan_, axes_, frame, radius, simulated_, landmark, nipple, where);
}

int AlignedView::block() const {
  return std::max(1, int(finest_hung / pixel_mm() + 0.5));
}

Vec2 AlignedView::hung_corner() const {
  const Vec2 last = axes_.mm(Vec2(scan_.header.columns - 1, scan_.header.rows - 1));
  const Vec2 half = Vec2::Constant(0.5 * pixel_mm());
  return left() ? Vec2(last.cwiseMin(0) - half) : Vec2(last.cwiseMax(0) + half);
}

ColourPicture AlignedView::hung() const {
  const MammogramHeader& header = scan_.header;
  const Vec2 along = axes_.mm(Vec2(1, 1)) * (left() ? 1 : -1);
  const int wide = block(), width = (header.columns + wide - 1) / wide,
            height = (header.rows + wide - 1) / wide;
  std::vector<float> sum(std::size_t(width) * std::size_t(height), 0), count(sum);
  for (int y = 0; y < header.rows; ++y) {
    for (int x = 0; x < header.columns; ++x) {
      const int column = along.x() > 0 ? x : header.columns - 1 - x;
      const int row = along.y() > 0 ? y : header.rows - 1 - y;
      const std::size_t to = std::size_t(y / wide) * std::size_t(width) + std::size_t(x / wide);
      sum[to] += scan_.at(column, row);
      count[to] += 1;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= count[i];
  return {width, height, sum};
}

void AlignedView::report(Report& report) const {
  const std::string key = "aligned/" + view_name(compression_.view) + "/";
  const Similarity& map = alignment_.map;
  report.set(key + "scale", map.scale);
  report.set(key + "rotation_deg", map.rotation_deg);
  report.set(key + "shift_mm", std::vector<double>{map.shift.x(), map.shift.y()});
  report.set(key + "scale_deviation", alignment_.scale_sd);
  report.set(key + "rotation_deviation_deg", alignment_.rotation_sd_deg);
  report.set(key + "residual_mm", alignment_.residual_mm);
  report.set(key + "pose_mm", alignment_.pose_mm);
  report.set(key + "nipple_mm", alignment_.nipple_mm);
  report.set(key + "edge_mm", alignment_.edge_mm);
  report.set(key + "outline_within_percent", 100 * alignment_.used);
  report.set(key + "deviation_mm", alignment_.deviation_mm());
  report.set(key + "pixel_mm", scan_.header.pixel_mm);
  report.set(key + "hung/pixel_mm", hung_pixel_mm());
  report.set(key + "hung/corner_mm", std::vector<double>{hung_corner().x(), hung_corner().y()});
  if (scan_.header.magnification != 1)
    report.set(key + "header/magnification", scan_.header.magnification);
  report.set(key + "simulated/thickness_mm", compression_.thickness_mm);
  if (scan_.header.thickness_mm)
    report.set(key + "header/thickness_mm", *scan_.header.thickness_mm);
  if (scan_.header.force_N) report.set(key + "header/force_N", *scan_.header.force_N);
  if (scan_.header.angle_deg) report.set(key + "header/angle_deg", *scan_.header.angle_deg);
}

std::vector<std::string> AlignedView::doubts() const {
  std::vector<std::string> doubts;
  const auto differs = [&](const char* what, const std::optional<double>& header, double simulated,
                           double bound, const char* unit) {
    if (!header || !(std::abs(*header - simulated) > bound)) return;
    doubts.push_back(where_ + ": " + what + " " + format_fixed(*header, 1) + unit +
                     ", simulated with " + format_fixed(simulated, 1) + unit +
                     "; compress with --like this file");
  };
  differs("thickness", scan_.header.thickness_mm, compression_.thickness_mm, 5, " mm");
  differs("angle", scan_.header.angle_deg, compression_.angle_deg, 5, " degrees");
  if (alignment_.residual_mm > 5) {
    doubts.push_back(where_ + ": outlines " + format_fixed(alignment_.residual_mm, 1) +
                     " mm apart after registration: the simulated breast has a different shape");
  }
  return doubts;
}

}  // namespace breast
