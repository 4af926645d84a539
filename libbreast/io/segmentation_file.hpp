// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations of 3D Slicer (.seg.nrrd): label volumes whose header names the segment of every
// value.
#pragma once

#include <filesystem>

#include "image/segments.hpp"

namespace breast {

/// True for .seg.nrrd and .seg.nhdr, in any case.
bool is_segmentation_name(const std::filesystem::path& file);

/// Throws Error (input) as read_volume, for a header without segments, and for overlapping
/// segments, which are stored in several layers.
SegmentedVolume read_segmentation(const std::filesystem::path& file);

/// Writes the tissues that occur, with names, colours and tags (segments_of), in LPS and
/// atomically.
void write_segmentation(const std::filesystem::path& file, const LabelVolume& labels);

}  // namespace breast
