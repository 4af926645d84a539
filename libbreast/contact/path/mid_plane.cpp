// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/mid_plane.hpp"

#include <algorithm>

namespace breast {

namespace {

/// Part of the closing by which the mid-plane moves where the plates' forces differ by their mean. A plate's force
/// falls to nothing when soft breasts move by 40 to 60 mm, so that a difference halves within 15 to 20 mm.
constexpr double part_of_closing = 2;
/// Additional weight of the force on a rounded edge, which holds nothing.
constexpr double edge_counts = 2;
/// Forces below this (N) say nothing: a fold of skin touches before the breast does.
constexpr double least_force_N = 10;
/// With this part of the closing one plate stands still.
constexpr double most = 0.5;

}  // namespace

double mid_plane_move(const PathPoint& here, double closing, double weight_N) {
  const double paddle = here.paddle_N + edge_counts * here.paddle_edge_N + weight_N;
  const double detector = here.detector_N + edge_counts * here.detector_edge_N;
  const double mean = std::max(least_force_N, 0.5 * (here.paddle_N + here.detector_N));
  const double part = part_of_closing * (detector - paddle) / mean;
  return std::max(0.0, closing) * std::clamp(part, -most, most);
}

}  // namespace breast
