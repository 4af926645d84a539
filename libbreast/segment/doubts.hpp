// SPDX-License-Identifier: GPL-3.0-or-later
// What a reader of a segmentation should look at.
#pragma once

#include "segment/plausibility.hpp"
#include "segment/segment.hpp"
#include "segment/work.hpp"

namespace breast {

/// Called last: adds a sentence for everything in the result that the user should check.
void add_doubts(Segmentation& result, const Work& work, const Extents& found);

}  // namespace breast
