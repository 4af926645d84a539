// SPDX-License-Identifier: GPL-3.0-or-later
// Label volumes whose header names the segment of every value: segmentations of 3D Slicer (.seg.nrrd) and
// DICOM Segmentation objects.
#pragma once

#include <filesystem>

#include "image/segments.hpp"
#include "io/volume_file.hpp"

namespace breast {

/// True for .seg.nrrd and .seg.nhdr, in any case, and for DICOM Segmentation objects of any name.
bool is_segmentation_file(const std::filesystem::path& file);

/// True for names that write_segmentation knows: .seg.nrrd and .dcm, in any case.
bool is_segmentation_name(const std::filesystem::path& file);

/// Throws Error (input) as read_volume and read_dicom_segmentation, for a header without segments, and for
/// overlapping segments, which 3D Slicer stores in several layers.
SegmentedVolume read_segmentation(const std::filesystem::path& file);

/// Writes the tissues that occur, with names, colours and tags (segments_of), in LPS and atomically; under a
/// name that ends with .dcm as write_dicom_segmentation does.
void write_segmentation(const std::filesystem::path& file, const LabelVolume& labels,
                        const DicomReference& scan = {});

}  // namespace breast
