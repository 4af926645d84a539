// SPDX-License-Identifier: GPL-3.0-or-later
// Quality scores of a segmentation, stage by stage.
#pragma once

#include <string>
#include <vector>

#include "segment/segment.hpp"

namespace breast {

/// Score of a stage: 1 is typical, at 0.5 the result should be checked, and 0 is as far again
/// beyond that.
struct StageQuality {
  std::string stage;  ///< contrast, wall, extent, tissue
  double score = 1;
  std::string worst;  ///< the quantity that decided
};

/// Score below which a stage is doubtful and the result must be checked.
constexpr double least_quality = 0.5;

/// One score a stage, the least of those of its quantities.
std::vector<StageQuality> quality_of(const Segmentation& result);

}  // namespace breast
