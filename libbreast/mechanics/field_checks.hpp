// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the solved fields for oscillating pressures and wrinkling skin.
#pragma once

#include "mechanics/equilibrium.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Fills pressure_quality (8-node elements) and skin from a solved state, and adds doubts.
void check_fields(const Scene& scene, Equilibrium& equilibrium);

}  // namespace breast
