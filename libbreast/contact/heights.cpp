// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/heights.hpp"

#include <algorithm>
#include <cmath>

#include "contact/grip.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

/// A move of about 1 cm, by which the height of a detector is corrected.
constexpr double part_of_thickness = 1.0 / 16;
/// Bounds of a second move, in units of the first.
constexpr double least_steps = 0.25, most_steps = 2;

bool is_accepted(const CompressionResult& result) {
  return result.converged() ||
         (result.record.status == SolveStatus::stopped_early && result.acceptable);
}

HeightTried record_of(const CompressionResult& result, double moved) {
  HeightTried height;
  height.moved_mm = moved;
  height.status = result.record.status;
  height.newton_iterations = result.newton_iterations;
  height.accepted = is_accepted(result);
  if (!result.contact) return height;
  height.thickness_mm = result.contact->thickness_mm;
  height.force_N = result.contact->plates[0].force_N;
  for (std::size_t k = 0; k < 2; ++k) height.edge_percent[k] = 100 * result.places.at(k).edge_part;
  return height;
}

/// By how much more the edge of the detector carries, percentage points.
double lean_on_detector(const HeightTried& at) {
  return at.edge_percent[1] - at.edge_percent[0];
}

}  // namespace

std::optional<double> next_height(const std::vector<HeightTried>& tried, double initial_thickness) {
  const HeightTried& first = tried.front();
  if (!(first.force_N > 0)) return {};
  if (std::max(first.edge_percent[0], first.edge_percent[1]) < most_edge_percent) return {};
  const double step = std::copysign(part_of_thickness * initial_thickness, lean_on_detector(first));
  if (tried.size() == 1) return step;
  const HeightTried& last = tried.back();
  if (!(last.force_N > 0)) return 0.5 * step;
  const double before = lean_on_detector(first), now = lean_on_detector(last);
  const double gained = (before - now) / before;  // part of the difference
  const double balanced = gained > 0 ? last.moved_mm / gained / step : most_steps;
  return std::clamp(balanced, least_steps, most_steps) * step;
}

CompressionResult at_best_height(
    const std::function<CompressionResult(std::optional<double> middle)>& compress_about,
    Progress& progress) {
  CompressionResult first = compress_about({});
  std::vector<HeightTried> heights = {record_of(first, 0)};
  for (int k = 0; k < most_other_heights && !heights.back().accepted; ++k) {
    const std::optional<double> moved = next_height(heights, first.plates.initial_thickness);
    if (!moved) break;
    const std::size_t loaded = *moved > 0 ? 1 : 0;
    const char* const name = loaded == 1 ? "detector" : "paddle";
    progress.note(message("the rounded edge of the ", name, " carries ",
                          std::round(heights.front().edge_percent[loaded]),
                          " % of its force: the breast is positioned again, with the plates ",
                          std::round(10 * std::abs(*moved)) / 10, " mm farther towards the ",
                          name));
    CompressionResult again = compress_about(first.plates.middle() + *moved);
    heights.push_back(record_of(again, *moved));
    if (heights.back().accepted) first = std::move(again);
  }
  first.heights = std::move(heights);
  return first;
}

}  // namespace breast
