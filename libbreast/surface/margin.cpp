// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/margin.hpp"

#include "core/elementary.hpp"

namespace breast {

bool within_margin(const Vec2& st, const SheetMargin& margin) {
  const Vec2 q = (st - Vec2(0.5, 0.5)).cwiseAbs() / (0.5 - margin.width);
  return elementary::pow(q.x(), margin.order) + elementary::pow(q.y(), margin.order) < 1;
}

}  // namespace breast
