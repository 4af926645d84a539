// SPDX-License-Identifier: GPL-3.0-or-later
// How far the labels are expected to be from the truth, by what the scan shows of it.
#pragma once

#include "segment/work.hpp"

namespace breast {

/// Mean distance (mm) of the labelled chest wall from the true one over the breast's columns. It is the sum of what the
/// voxels cannot resolve, by their depth and by the wall's rise across them, and of 5 mm times what the wall's
/// confidence lacks to one.
double expected_wall_mm(const Work& work);

/// Dice coefficient of the labelled breast with the true one. Missed are a quarter of a voxel along skin and border,
/// expected_wall_mm() along the wall, and what the field of view cuts off, which is taken for the cap of a ball.
double expected_breast_dice(const Work& work, double cut_by_view_cm2);

}  // namespace breast
