// SPDX-License-Identifier: GPL-3.0-or-later
// The results of a comparison as named numbers for tables and reports.
#pragma once

#include <string>
#include <vector>

#include "core/distances.hpp"
#include "core/quantity.hpp"
#include "evaluation/partial_volume.hpp"
#include "image/label_volume.hpp"

namespace breast {

std::vector<Quantity> distance_quantities(const std::string& name, const Distances& distances);
std::vector<Quantity> fraction_quantities(const PartialVolume& fractions);
/// Dice coefficient and volume of every tissue present, of breast and body, and the distances of
/// walls and nipples. `half` as for gland_dice_in_breast.
std::vector<Quantity> label_quantities(const LabelVolume& given, const LabelVolume& truth,
                                       const std::vector<bool>& half = {});

}  // namespace breast
