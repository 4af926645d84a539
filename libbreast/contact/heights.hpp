// SPDX-License-Identifier: GPL-3.0-or-later
// The height of the plates along the beam, chosen as by a technologist, who moves the detector and positions the
// breast again when the edge of a plate, instead of its flat part, carries the breast.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "contact/compression.hpp"

namespace breast {

/// Distance, in mm along the beam and positive towards the detector, by which the plates are moved before the
/// breast is positioned for the `attempt`-th time again (from 1): a sixteenth of T0 an attempt, away from the
/// plate whose rounded edge carries the larger share of its force. Absent if no edge of `first` carries too much
/// or nothing is known of its forces.
std::optional<double> other_height(const CompressionResult& first, int attempt);

/// Largest number of attempts after the first.
constexpr int most_other_heights = 2;

/// Calls `compress_about` with the coordinate, along the beam, of the plane about which the plates close (absent:
/// as they stand by themselves), until a result is accepted or no other height promises one. Returns the first
/// accepted result, else the first one; CompressionResult::heights has them all.
CompressionResult at_best_height(
    const std::function<CompressionResult(std::optional<double> middle)>& compress_about,
    Progress& progress);

}  // namespace breast
