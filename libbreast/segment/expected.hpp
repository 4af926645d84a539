// SPDX-License-Identifier: GPL-3.0-or-later
// How far the labels are expected to be from the truth, by what the scan shows of it.
#pragma once

#include "segment/work.hpp"

namespace breast {

/// Mean distance (mm) of the labelled chest wall from the true one, over the breast's columns: that to which voxels can
/// say where a wall lies that rises within them, and that of a wall that was not seen as far as it was not.
double expected_wall_mm(const Work& work);

/// Dice coefficient of the labelled breast with the true one: what is missed along its surface, a quarter of a voxel at
/// skin and border and as above at the wall, and what the field of view cuts off, which is taken for the cap of a ball.
double expected_breast_dice(const Work& work, double cut_by_view_cm2);

}  // namespace breast
