// SPDX-License-Identifier: GPL-3.0-or-later
// The mid-plane between the plates follows the breast along the beam: a technologist raises the detector, and the
// woman yields, until neither plate drags the breast along its chest wall.
#pragma once

#include "contact/path/target.hpp"

namespace breast {

/// Displacement (mm, positive towards the detector) of the mid-plane in a step that closes the plates by `closing` mm
/// from the state `here`. The plate that presses more waits, at most until it stands still: no plate retreats. What
/// counts is the force of a plate, with that on its rounded edge counted three times, and on the paddle's side the weight
/// along the beam that no hand carries, `weight_N` (N, positive towards the detector), which is the detector's.
double mid_plane_move(const PathPoint& here, double closing, double weight_N);

}  // namespace breast
