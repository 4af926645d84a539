// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/target.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

constexpr double kilopascal_per_newton_per_cm2 = 10;

/// A target followed by its alternatives.
std::vector<CompressionTarget> all_of(const CompressionTarget& target) {
  std::vector<CompressionTarget> all{{target.kind, target.value, {}, target.least_area_cm2}};
  all.insert(all.end(), target.or_at.begin(), target.or_at.end());
  return all;
}

}  // namespace

std::array<double, 2> edge_parts(const PathPoint& point) {
  const auto part = [](double edge, double force) { return force > 0 ? edge / force : 0; };
  return {part(point.paddle_edge_N, point.paddle_N), part(point.detector_edge_N, point.detector_N)};
}

double largest_edge_part(const PathPoint& point) {
  return std::ranges::max(edge_parts(point));
}

const char* target_name(TargetKind kind) {
  constexpr const char* names[] = {"thickness", "paddle force", "mean pressure", "contact area"};
  return names[int(kind)];
}

double measure(const PathPoint& point, const CompressionTarget& target) {
  switch (target.kind) {
    case TargetKind::thickness:
      return point.thickness;
    case TargetKind::force:
      return point.paddle_N;
    case TargetKind::pressure:
      if (point.area_cm2 >= target.least_area_cm2) return point.pressure_kPa;
      return point.paddle_N * kilopascal_per_newton_per_cm2 / target.least_area_cm2;
    case TargetKind::area:
      return point.area_cm2;
  }
  return 0;
}

CompressionTarget target_of(const CompressionStop& stop, double initial) {
  switch (stop.at) {
    case StopAt::thickness:
      return {TargetKind::thickness, stop.value};
    case StopAt::reduction:
      return {TargetKind::thickness, initial * (1 - stop.value / 100)};
    case StopAt::force:
      return {TargetKind::force, stop.value};
    case StopAt::pressure:
      return {TargetKind::pressure, stop.value};
    case StopAt::area:
      return {TargetKind::area, stop.value};
  }
  return {};
}

std::optional<double> thickness_in(const CompressionTarget& target) {
  std::optional<double> largest;
  for (const CompressionTarget& one : all_of(target)) {
    if (one.kind == TargetKind::thickness)
      largest = std::max(one.value, largest.value_or(one.value));
  }
  return largest;
}

std::vector<CompressionTarget> others_than_thickness(const CompressionTarget& target) {
  std::vector<CompressionTarget> others = all_of(target);
  std::erase_if(others, [](const auto& one) { return one.kind == TargetKind::thickness; });
  return others;
}

double closing_at(double way, const CompressionTarget& target) {
  return others_than_thickness(target).empty() ? way : std::cbrt(way);
}

double part_of_way(const PathPoint& end, const CompressionTarget& target, double initial) {
  const bool only_thickness = others_than_thickness(target).empty();
  const auto part = [&](const CompressionTarget& wanted) {
    if (wanted.kind != TargetKind::thickness) return measure(end, wanted) / wanted.value;
    const double closing = (initial - end.thickness) / (initial - wanted.value);
    return only_thickness ? closing : std::pow(closing, 3);
  };
  double most = part(target);
  for (const CompressionTarget& one : all_of(target)) most = std::max(most, part(one));
  return most;
}

double expected_part_of_way(double thickness, const PathPoint& here, const PathPoint* before,
                            const CompressionTarget& target, double initial) {
  PathPoint there = here;
  there.thickness = thickness;
  if (before != nullptr && before->thickness != here.thickness) {
    const double ratio = (thickness - here.thickness) / (here.thickness - before->thickness);
    const auto go_on = [&](double PathPoint::*what) {
      there.*what += ratio * (here.*what - before->*what);
    };
    go_on(&PathPoint::paddle_N);
    go_on(&PathPoint::pressure_kPa);
    go_on(&PathPoint::area_cm2);
  }
  return part_of_way(there, target, initial);
}

}  // namespace breast
