// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/correspondence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "mesh/part.hpp"

namespace breast {

namespace {

constexpr std::size_t fewest_points = 64;

std::string view_of(const HexMesh& mesh) {
  return mesh.contact ? view_name(mesh.contact->view) : "no compression";
}

void check_same_body(const HexMesh& from, const HexMesh& to) {
  const std::string first = view_of(from), second = view_of(to);
  if (!from.contact || !to.contact ||
      std::abs(from.contact->angle_deg - to.contact->angle_deg) < 1) {
    throw input_error("the first mesh shows ", first, ", the second ", second,
                      "; give two compressions in different views, such as CC and MLO");
  }
  if (from.side != to.side) {
    throw input_error("the ", first, " mesh is of the ", side_name(from.side), " breast, the ",
                      second, " mesh of the ", side_name(to.side));
  }
  if (!have_same_elements(from, to)) {
    throw input_error("the ", first, " and ", second, " meshes have different elements (",
                      from.elements(), " and ", to.elements(),
                      "); both must be compressions of one mesh");
  }
  for (int i = 0; i < from.nodes(); ++i) {
    const double apart = (from.imaged[i] - to.imaged[i]).norm();
    if (!(apart <= 1e-6)) {
      throw input_error("node ", i, " of the ", first, " and ", second, " meshes is ", apart,
                        " mm apart in the imaged shape; both must be compressions of one mesh");
    }
  }
}

double segment_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double length2 = d.squaredNorm();
  const double f = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (p - a - f * d).norm();
}

// Largest distance of `middle` from the middle of the straight segment, over image and shapes.
double departure(const ColumnPoint& a, const ColumnPoint& middle, const ColumnPoint& b) {
  const auto bend = [](const auto& x, const auto& m, const auto& y) {
    return (m - 0.5 * (x + y)).norm();
  };
  return std::max({bend(a.to_uv, middle.to_uv, b.to_uv), bend(a.to, middle.to, b.to),
                   bend(a.reference, middle.reference, b.reference),
                   bend(a.imaged, middle.imaged, b.imaged)});
}

double line_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = (b - a).stableNormalized();
  return ((p - a) - (p - a).dot(d) * d).norm();
}

// Part of the segment from a to b that lies in the image, 0 to 1 (Liang and Barsky's clipping).
double inside_part(const Vec2& a, const Vec2& b, const ImageFrame& frame) {
  double enter = 0, leave = 1;
  const Vec2 size(frame.width, frame.height);
  for (int k = 0; k < 2; ++k) {
    const double d = b[k] - a[k];
    const double low = -a[k], high = size[k] - a[k];
    if (d == 0) {
      if (low > 0 || high < 0) return 0;
      continue;
    }
    enter = std::max(enter, std::min(low / d, high / d));
    leave = std::min(leave, std::max(low / d, high / d));
  }
  return std::max(0.0, leave - enter);
}

void measure(MatchedCurve& curve, const ImageFrame& to) {
  if (curve.points.empty()) return;
  const Vec2 first = curve.points.front().to_uv, last = curve.points.back().to_uv;
  curve.chord = (last - first).norm();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ColumnPoint& point = curve.points[i];
    curve.max_deviation = std::max(curve.max_deviation, segment_distance(point.to_uv, first, last));
    curve.reference_deviation = std::max(
        curve.reference_deviation, line_distance(point.reference, curve.points.front().reference,
                                                 curve.points.back().reference));
    if (i == 0 || curve.points[i - 1].stretch != point.stretch) continue;
    const Vec2& before = curve.points[i - 1].to_uv;
    const double step = (point.to_uv - before).norm();
    curve.length += step;
    if (0.5 * (point.to_uv.x() + before.x()) < 0) curve.behind_image += step;
    curve.inside_image += step * inside_part(before, point.to_uv, to);
  }
}

std::optional<Vec2> project_landmark(const HexMesh& mesh, const ViewPose& pose,
                                     std::string_view name) {
  const Landmark* landmark = mesh.landmark(name);
  if (landmark == nullptr) return std::nullopt;
  return pose.project(landmark_position(mesh, mesh.points, *landmark));
}

}  // namespace

Matcher::Matcher(const HexMesh& from, const HexMesh& to, Beam beam)
    : from_((check_same_body(from, to), from)),
      to_(to),
      from_frame_(image_frame(from, beam)),
      to_frame_(image_frame(to, beam)),
      from_rays_(from, from.points, from_frame_.pose),
      to_rays_(to, to.points, to_frame_.pose) {}

ColumnPoint Matcher::point_on(const Ray& ray, const Chord& chord, double distance) const {
  const double f = (distance - chord.enter) / (chord.leave - chord.enter);
  Vec3 local = (1 - f) * chord.local_enter + f * chord.local_leave;
  from_rays_.piece(chord.piece).invert(ray.at(distance), 1e-10, local);
  ColumnPoint point;
  point.element = from_rays_.element(chord.piece);
  point.local = from_rays_.element_local(chord.piece, local).cwiseMax(-1.0).cwiseMin(1.0);
  point.depth = distance;
  const auto in = [&](const HexMesh& mesh, const std::vector<Vec3>& nodal) {
    return element_position(mesh, nodal, point.element, point.local);
  };
  point.from = in(from_, from_.points);
  point.to = in(to_, to_.points);
  point.imaged = in(from_, from_.imaged);
  point.reference = from_.reference.empty() ? point.imaged : in(from_, from_.reference);
  point.to_uv = to_frame_.pose.project(point.to);
  return point;
}

// Appends the points after `from` up to `to`; points.back() is the one at `from`.
void Matcher::refine(const Ray& ray, const Chord& chord, double from, double to, double tolerance,
                     int depth, std::vector<ColumnPoint>& points) const {
  const ColumnPoint middle = point_on(ray, chord, 0.5 * (from + to));
  const ColumnPoint end = point_on(ray, chord, to);
  // Within one element the curve is a polynomial of low degree: half its distance from the chord at
  // the middle is an ample bound of the error after one bisection.
  if (depth < 12 && departure(points.back(), middle, end) > 0.5 * tolerance) {
    refine(ray, chord, from, 0.5 * (from + to), tolerance, depth + 1, points);
    refine(ray, chord, 0.5 * (from + to), to, tolerance, depth + 1, points);
    return;
  }
  points.push_back(middle);
  points.push_back(end);
}

MatchedCurve Matcher::match(const Vec2& from_uv, double tolerance) const {
  MatchedCurve curve;
  curve.from_uv = from_uv;
  std::vector<Chord> chords;
  from_rays_.trace(from_uv, chords);
  curve.through_back = from_rays_.leaves_through_back(chords);
  if (chords.empty()) return curve;
  const Ray ray = from_rays_.ray(from_uv);
  const std::size_t parts = 1 + fewest_points / (2 * chords.size());
  double tissue = 0;  // passed before this chord
  int stretch = 0;
  for (std::size_t c = 0; c < chords.size(); ++c) {
    const Chord& chord = chords[c];
    constexpr double gap = 1e-6;  // mm: chords of neighbours meet to rounding
    if (c > 0 && chord.enter - chords[c - 1].leave > gap) ++stretch;
    std::vector<ColumnPoint> points{point_on(ray, chord, chord.enter)};
    for (std::size_t k = 0; k < parts; ++k) {
      const double step = (chord.leave - chord.enter) / double(parts);
      refine(ray, chord, chord.enter + double(k) * step, chord.enter + double(k + 1) * step,
             tolerance, 0, points);
    }
    const bool joined = !curve.points.empty() && curve.points.back().stretch == stretch;
    for (std::size_t i = joined ? 1 : 0; i < points.size(); ++i) {
      points[i].depth += tissue - chord.enter;
      points[i].stretch = stretch;
      curve.points.push_back(points[i]);
    }
    tissue += chord.leave - chord.enter;
  }
  measure(curve, to_frame_);
  return curve;
}

std::optional<Vec2> Matcher::from_landmark(std::string_view name) const {
  return project_landmark(from_, from_frame_.pose, name);
}

std::optional<Vec2> Matcher::to_landmark(std::string_view name) const {
  return project_landmark(to_, to_frame_.pose, name);
}

bool Matcher::tissue_in_to(const Vec2& uv) const {
  std::vector<Chord> chords;
  to_rays_.trace(uv, chords);
  return !chords.empty();
}

bool Matcher::tissue_in_from(const Vec2& uv) const {
  std::vector<Chord> chords;
  from_rays_.trace(uv, chords);
  return !chords.empty();
}

double Matcher::nipple_distance(const Vec2& from_uv) const {
  const std::optional<Vec2> nipple = from_landmark("nipple");
  return nipple ? (from_uv - *nipple).norm() : 0;
}

std::optional<double> Matcher::nipple_depth_line(const Vec2& from_uv) const {
  const auto first = from_landmark("nipple"), second = to_landmark("nipple");
  if (!first || !second) return std::nullopt;
  return second->x() - (first->x() - from_uv.x());
}

std::vector<std::vector<Vec2>> Matcher::nipple_arc(const Vec2& from_uv) const {
  std::vector<std::vector<Vec2>> stretches;
  const std::optional<Vec2> nipple = to_landmark("nipple");
  const double radius = nipple_distance(from_uv);
  if (!nipple || !(radius > 0)) return stretches;
  const int steps = std::clamp(int(std::numbers::pi * radius / 0.25), 90, 4000);
  bool inside = false;
  for (int k = 0; k <= steps; ++k) {  // the posterior half circle, from one side to the other
    const double angle = std::numbers::pi * (0.5 + double(k) / steps);
    const Vec2 uv = *nipple + radius * Vec2(std::cos(angle), std::sin(angle));
    const bool tissue = uv.x() >= 0 && tissue_in_to(uv);
    if (tissue && !inside) stretches.emplace_back();
    if (tissue) stretches.back().push_back(uv);
    inside = tissue;
  }
  return stretches;
}

double distance_to_curve(const MatchedCurve& curve, const Vec2& to_uv) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ColumnPoint& point = curve.points[i];
    nearest = std::min(nearest, (to_uv - point.to_uv).norm());
    if (i > 0 && curve.points[i - 1].stretch == point.stretch) {
      nearest = std::min(nearest, segment_distance(to_uv, curve.points[i - 1].to_uv, point.to_uv));
    }
  }
  return nearest;
}

}  // namespace breast
