// SPDX-License-Identifier: GPL-3.0-or-later
// Colour scale for values, and its legend.
#pragma once

#include <string>
#include <vector>

#include "figures/canvas.hpp"

namespace breast {

/// Colours from light to dark with even steps in lightness, legible in grey; `t` in [0,1].
Colour heat(double t);

/// The smallest number, of the form step times a power of ten with a step from `steps` (in [1,
/// 10)), that is at least `value` > 0.
double round_up(double value, const std::vector<double>& steps = {1, 2, 5});

/// Draws a vertical bar from 0 to `high` along the right side of the panel, with a title.
void colour_bar(Panel& panel, double high, const std::string& title);

}  // namespace breast
