// SPDX-License-Identifier: GPL-3.0-or-later
// The measured quantities of a segmentation as named numbers, for the report and for a table.
#pragma once

#include <vector>

#include "core/quantity.hpp"
#include "segment/segment.hpp"

namespace breast {

std::vector<Quantity> measures_of(const Segmentation& result);

}  // namespace breast
