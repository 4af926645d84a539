// SPDX-License-Identifier: GPL-3.0-or-later
// Division of a series whose images lie at the same places: time points, kinds of image, slabs.
#pragma once

#include <vector>

#include "io/series/stack.hpp"

namespace breast {

/// Sorts the slices by their place along the normal of the first.
void sort_slices(std::vector<DicomImage>& slices);
/// mm along the normal of the first slice.
std::vector<double> places_of(const std::vector<DicomImage>& slices);

/// One stack for every time point and kind of image; the stack itself, sorted, if its places are distinct or
/// nothing tells its images apart.
std::vector<DicomStack> by_time_and_kind(DicomStack stack);

/// Two slabs of sagittal slices, right and left, or the stack itself.
std::vector<DicomStack> by_slab(DicomStack stack);

}  // namespace breast
