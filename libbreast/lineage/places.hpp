// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of what two files show in the frame of the scan, where histories do not tell.
#pragma once

#include <string>

#include "lineage/origin.hpp"

namespace breast {

/// How the two lie at different places, as words; "" if they do not or if it is not known. Compared
/// are the bounding boxes, of which the smaller one must lie in the other by at least half, and the
/// nipples, at most 15 mm apart.
std::string places_differ(const Origin& a, const Origin& b);

/// How the breasts of two label volumes differ, as words; "" if they share at least 70 % of their
/// union, as a corrected copy does.
std::string breasts_differ(const LabelVolume& a, const LabelVolume& b);

}  // namespace breast
