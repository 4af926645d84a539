// SPDX-License-Identifier: GPL-3.0-or-later
// Quality scores of a segmentation, stage by stage.
#pragma once

#include <string>
#include <vector>

#include "segment/segment.hpp"

namespace breast {

/// Score of a stage: 1 as usual, 0.5 where a reader has to look, 0 as far beyond again.
struct StageQuality {
  std::string stage;  ///< contrast, wall, extent, tissue
  double score = 1;
  std::string worst;  ///< the quantity that decided
};

/// Below this a stage is doubtful and the result has to be looked at.
constexpr double least_quality = 0.5;

/// One score a stage, the least of those of its quantities.
std::vector<StageQuality> quality_of(const Segmentation& result);

}  // namespace breast
