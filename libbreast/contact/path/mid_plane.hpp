// SPDX-License-Identifier: GPL-3.0-or-later
// The mid-plane between the plates follows the breast along the beam: a technologist raises the detector, and the
// woman yields, until neither plate drags the breast along its chest wall.
#pragma once

#include "contact/path/target.hpp"

namespace breast {

/// Displacement (mm, positive towards the detector) of the mid-plane in a step that closes the plates by `closing` mm
/// from the state `here`. The plate that presses more moves more slowly, or stands still, but never retreats. The
/// plates are balanced when the detector presses with the force of the paddle and carries `weight_N`, the weight along
/// the beam that no hand carries (N, positive towards the detector). The force on a rounded edge counts three times.
double mid_plane_move(const PathPoint& here, double closing, double weight_N);

}  // namespace breast
