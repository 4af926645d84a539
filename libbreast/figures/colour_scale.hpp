// SPDX-License-Identifier: GPL-3.0-or-later
// Colour scale for values, and its legend.
#pragma once

#include <string>
#include <vector>

#include "figures/canvas.hpp"

namespace breast {

/// Light to dark with even steps in lightness, legible in grey; `t` in [0,1].
Colour heat(double t);

/// The smallest of `steps` (in [1, 10)) times a power of ten that is not below `value` > 0.
double round_up(double value, const std::vector<double>& steps = {1, 2, 5});

/// Vertical bar from 0 to `high` along the panel's right side, titled.
void colour_bar(Panel& panel, double high, const std::string& title);

}  // namespace breast
