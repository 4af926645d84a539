// SPDX-License-Identifier: GPL-3.0-or-later
// The height of the plates along the beam, chosen as by a technologist, who moves the detector and positions the
// breast again when the edge of a plate, instead of its flat part, carries the breast.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "contact/compression.hpp"

namespace breast {

/// Distance, in mm along the beam and positive towards the detector, by which the plates are moved from their first
/// height before the breast, whose T0 between them is `initial_thickness` mm, is positioned again. First a sixteenth
/// of T0, away from the plate whose rounded edge carries the larger share of its force; then as far as would give
/// both edges the same share by the last two attempts, within a quarter and twice of that; half as far if the last
/// attempt shows no forces. Absent if no edge carried too much at first, or nothing is known of its forces.
std::optional<double> next_height(const std::vector<HeightTried>& tried, double initial_thickness);

/// Largest number of attempts after the first.
constexpr int most_other_heights = 2;

/// Calls `compress_about` with the coordinate, along the beam, of the plane about which the plates close (absent:
/// as they stand by themselves), until a result is accepted or no other height promises one. Returns the first
/// accepted result, else the first one; CompressionResult::heights has them all.
CompressionResult at_best_height(
    const std::function<CompressionResult(std::optional<double> middle)>& compress_about,
    Progress& progress);

}  // namespace breast
