// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/heights.hpp"

#include <cmath>

#include "contact/grip.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

/// A move of about 1 cm, by which the height of a detector is corrected.
constexpr double part_of_thickness = 1.0 / 16;

bool is_accepted(const CompressionResult& result) {
  return result.converged() ||
         (result.record.status == SolveStatus::stopped_early && result.acceptable);
}

HeightTried tried(const CompressionResult& result, double moved) {
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

}  // namespace

std::optional<double> other_height(const CompressionResult& first, int attempt) {
  if (!first.contact || first.places.size() < 2) return {};
  const double paddle = 100 * first.places[0].edge_part, detector = 100 * first.places[1].edge_part;
  if (std::max(paddle, detector) < most_edge_percent) return {};
  const double step = part_of_thickness * first.plates.initial_thickness;
  return std::copysign(attempt * step, detector - paddle);
}

CompressionResult at_best_height(
    const std::function<CompressionResult(std::optional<double> middle)>& compress_about,
    Progress& progress) {
  CompressionResult first = compress_about({});
  std::vector<HeightTried> heights = {tried(first, 0)};
  for (int k = 1; k <= most_other_heights && !heights.back().accepted; ++k) {
    const std::optional<double> moved = other_height(first, k);
    if (!moved) break;
    const int edge = *moved > 0 ? 1 : 0;
    progress.note(message("the rounded edge of the ", edge == 1 ? "detector" : "paddle",
                          " carries ", std::round(heights.front().edge_percent[std::size_t(edge)]),
                          " % of its force: the breast is positioned again with the plates ",
                          std::abs(*moved), " mm farther towards the ",
                          edge == 1 ? "detector" : "paddle"));
    CompressionResult again = compress_about(first.plates.middle() + *moved);
    heights.push_back(tried(again, *moved));
    if (!heights.back().accepted) continue;
    first = std::move(again);
  }
  first.heights = std::move(heights);
  return first;
}

}  // namespace breast
