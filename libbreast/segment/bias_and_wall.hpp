// SPDX-License-Identifier: GPL-3.0-or-later
// The stages on the working grid: the coil's sensitivity from fat, and the chest wall behind it.
#pragma once

#include "core/progress.hpp"
#include "core/report.hpp"
#include "segment/work.hpp"

namespace breast {

/// Gland that misled the estimate of the bias, which is then made again.
struct MisleadingGland {
  Volume<float> share;  ///< where no fat is sought; empty when none misleads
  DimTissue compact;    ///< what was missed for being compact; its share is empty when nothing was
};

/// Bias and chest wall, in two passes.
void find_wall(Work& work, Progress& progress, Timer& timer);

/// The final bias of the working grid, from the fat in front of the wall.
void refine_bias(Work& work, const MisleadingGland* gland = nullptr);

}  // namespace breast
