// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/aligned_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

constexpr double finest_hung = 0.25;  // mm

/// The scan, if it is of the simulated breast and view.
MammogramScan checked(MammogramScan scan, const SimulatedView& simulated,
                      const std::string& where) {
  if (scan.header.side != simulated.side) {
    throw input_error(where, ": a mammogram of the ", side_name(scan.header.side),
                      " breast, but the meshes are of the ", side_name(simulated.side));
  }
  if (scan.header.view != simulated.compression.view) {
    throw input_error(where, ": shows ", view_name(scan.header.view), ", the mesh ",
                      view_name(simulated.compression.view));
  }
  return scan;
}

/// The beginning of sentences that a report keeps: they name no folder.
std::string image_of(View view) {
  return view_name(view) + " image: ";
}

/// Turns the grey values where the image shows that its header states them inverted.
std::optional<AirSeen> with_dark_air(MammogramScan& scan, const ImageField& field,
                                     const std::string& where) {
  const std::optional<AirSeen> air = seen_air(scan, field, where);
  if (air && air->bright) {
    for (float& value : scan.grey) value = 1 - value;
    scan.header.remarks.push_back(image_of(scan.header.view) +
                                  "its grey values are inverted: its air is bright, although it "
                                  "states " +
                                  (scan.header.bright_is_low ? "MONOCHROME1" : "MONOCHROME2"));
  }
  return air;
}

Hanging hanging_of(MammogramScan& scan, const ViewPose& pose, const std::string& where) {
  const ImageField field = image_field(scan);
  const std::optional<AirSeen> air = with_dark_air(scan, field, where);
  Hanging hanging = hang_image(scan.header, pose, air, where);
  hanging.axes.restrict_to(field);
  return hanging;
}

/// The image in one orientation, and how well it fits.
struct Way {
  ImageAxes axes;
  AlignmentData data;
  std::optional<Alignment> found;
  double residual_mm = std::numeric_limits<double>::infinity();
};

void align(Way& way, const MammogramScan& scan, const std::optional<Vec2>& mark,
           const std::string& where) {
  way.data.real = image_outline(scan, way.axes, where);
  if (mark) way.data.nipple->second = way.axes.mm(*mark);
  way.found = align_outlines(way.data, way.axes, where);
  way.residual_mm = way.found->residual_mm;
}

/// The better of both ways up, if the header does not say which it is.
Way either_way(Way way, const MammogramScan& scan, std::string& doubt,
               const std::optional<Vec2>& mark, const std::string& where) {
  Way other = way;
  other.axes = way.axes.upside_down();
  for (Way* one : {&way, &other}) {
    try {
      align(*one, scan, mark, where);
    } catch (const Error&) {
      continue;  // it does not fit at all
    }
  }
  if (other.residual_mm < way.residual_mm) std::swap(way, other);
  if (!fits_better(way.residual_mm, other.residual_mm)) {
    for (const Way* one : {&way, &other}) {
      if (one->found) check_scale(one->data, one->axes, *one->found, where);
    }
    throw input_error(where, ": ", doubt, ", and its outline fits either way up (", way.residual_mm,
                      " and ", other.residual_mm,
                      " mm); correct its Patient Orientation (0020,0020)");
  }
  doubt += message("; it hangs as its outline fits (", format_fixed(way.residual_mm, 1),
                   " mm, upside down ", format_fixed(other.residual_mm, 1),
                   "): check that it is of this breast");
  return way;
}

Alignment aligned(const MammogramScan& scan, Hanging& hanging, const SimulatedView& simulated,
                  const std::optional<Vec2>& mark, const std::string& where) {
  Way way{hanging.axes, {}, {}};
  way.data.simulated = simulated.outline;
  way.data.plate_edge_u = simulated.plate_edge_u;
  if (mark && !simulated.nipple)
    throw input_error(where, ": a nipple is marked, but the mesh has none");
  if (mark) way.data.nipple = {*simulated.nipple, Vec2::Zero()};
  if (hanging.upright_known) {
    align(way, scan, mark, where);
    check_upright(way.data, way.axes, *way.found, where);
  } else {
    way = either_way(std::move(way), scan, hanging.doubt, mark, where);
    hanging.axes = way.axes;
  }
  check_scale(way.data, way.axes, *way.found, where);
  return *way.found;
}

const ImageFrame& frame_of(const Matcher& matcher, MatchEnd end) {
  return end == MatchEnd::from ? matcher.from_frame() : matcher.to_frame();
}

}  // namespace

SimulatedView::SimulatedView(const Matcher& matcher, MatchEnd end)
    : side(matcher.from().side),
      compression(*(end == MatchEnd::from ? matcher.from() : matcher.to()).contact),
      pose(frame_of(matcher, end).pose),
      plate_edge_u(frame_of(matcher, end).plate_edge_u -
                   (compression.plates.empty() ? 0 : compression.plates.front().edge_radius)),
      nipple(end == MatchEnd::from ? matcher.from_landmark("nipple")
                                   : matcher.to_landmark("nipple")) {
  outline = simulated_outline(
      [&](const Vec2& uv) {
        return end == MatchEnd::from ? matcher.tissue_in_from(uv) : matcher.tissue_in_to(uv);
      },
      frame_of(matcher, end));
}

AlignedView::AlignedView(MammogramScan scan, SimulatedView simulated,
                         const std::optional<Vec2>& nipple, const std::string& where)
    : scan_(checked(std::move(scan), simulated, where)),
      simulated_(std::move(simulated)),
      hanging_(hanging_of(scan_, simulated_.pose, where)),
      alignment_(aligned(scan_, hanging_, simulated_, nipple, where)) {}

int AlignedView::block() const {
  return std::max(1, int(finest_hung / pixel_mm() + 0.5));
}

Vec2 AlignedView::hung_corner() const {
  const Vec2 last = hanging_.axes.mm(Vec2(scan_.header.columns - 1, scan_.header.rows - 1));
  const Vec2 half = Vec2::Constant(0.5 * pixel_mm());
  return left() ? Vec2(last.cwiseMin(0) - half) : Vec2(last.cwiseMax(0) + half);
}

ColourPicture AlignedView::hung() const {
  const MammogramHeader& header = scan_.header;
  const Vec2 along = hanging_.axes.mm(Vec2(1, 1)) * (left() ? 1 : -1);
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
  const std::string key = "aligned/" + view_name(simulated_.compression.view) + "/";
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
  report.set(key + "simulated/thickness_mm", simulated_.compression.thickness_mm);
  if (scan_.header.thickness_mm)
    report.set(key + "header/thickness_mm", *scan_.header.thickness_mm);
  if (scan_.header.force_N) report.set(key + "header/force_N", *scan_.header.force_N);
  if (scan_.header.angle_deg) report.set(key + "header/angle_deg", *scan_.header.angle_deg);
}

std::vector<std::string> AlignedView::remarks() const {
  std::vector<std::string> remarks = scan_.header.remarks;
  remarks.push_back(image_of(scan_.header.view) + "registered with its outline " +
                    format_fixed(alignment_.residual_mm, 2) + " mm from the simulated one");
  return remarks;
}

std::vector<std::string> AlignedView::doubts() const {
  std::vector<std::string> doubts;
  if (!hanging_.doubt.empty()) doubts.push_back(image_of(scan_.header.view) + hanging_.doubt);
  const auto differs = [&](const char* what, const std::optional<double>& header, double simulated,
                           double bound, const char* unit) {
    if (!header || !(std::abs(*header - simulated) > bound)) return;
    doubts.push_back(image_of(scan_.header.view) + what + " " + format_fixed(*header, 1) + unit +
                     ", simulated with " + format_fixed(simulated, 1) + unit +
                     "; compress with --like this file");
  };
  differs("thickness", scan_.header.thickness_mm, simulated_.compression.thickness_mm, 5, " mm");
  differs("angle", scan_.header.angle_deg, simulated_.compression.angle_deg, 5, " degrees");
  if (alignment_.residual_mm > 5) {
    doubts.push_back(image_of(scan_.header.view) + "outlines " +
                     format_fixed(alignment_.residual_mm, 1) +
                     " mm apart after registration: the simulated breast has a different shape");
  }
  return doubts;
}

}  // namespace breast
