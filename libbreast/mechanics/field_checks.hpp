// SPDX-License-Identifier: GPL-3.0-or-later
// What the solved fields say about their own worth: pressure oscillation and wrinkling skin.
#pragma once

#include "mechanics/equilibrium.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// From a solved state: fills pressure_quality (8-node elements) and skin, and adds what to doubt.
void check_fields(const Scene& scene, Equilibrium& equilibrium);

}  // namespace breast
