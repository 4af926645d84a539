// SPDX-License-Identifier: GPL-3.0-or-later
// Quality scores of a segmentation, stage by stage.
#pragma once

#include <string>
#include <vector>

#include "segment/segment.hpp"

namespace breast {

/// Score of a stage, linear between 1 for typical values, 0.5 where the result should be checked,
/// and 0.
struct StageQuality {
  std::string stage;  ///< contrast, wall, extent, tissue
  double score = 1;
  std::string worst;  ///< the quantity with the lowest score
};

/// Dice coefficient of labelled fibroglandular tissue that its fractions let expect: if the fraction of a voxel is the
/// probability that it is gland, twice the sum over labelled voxels, over their number and the sum over the breast. 1 without gland.
double expected_gland_dice(const LabelVolume& labels);

/// Score below which a stage is doubtful and the result must be checked.
constexpr double least_quality = 0.5;

/// One score per stage, the lowest of its quantities.
std::vector<StageQuality> quality_of(const Segmentation& result);

}  // namespace breast
