// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a sheet that is trusted: its border is kept outside the body.
#pragma once

#include "core/types.hpp"

namespace breast {

struct SheetMargin {
  double width = 0.035;  ///< range of the sheet's parameters that is kept outside
  int order = 5;  ///< of the superellipse within the sheet's border, so that it has no corners
};

/// True where the body may lie: within the superellipse that keeps a distance from the border.
bool within_margin(const Vec2& st, const SheetMargin& margin);

}  // namespace breast
