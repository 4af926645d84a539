// SPDX-License-Identifier: GPL-3.0-or-later
// DICOM Segmentation objects (PS3.3 A.51): frames of one segment in one slice each, or label maps of slices.
#pragma once

#include <filesystem>

#include "image/segments.hpp"
#include "io/volume_file.hpp"

namespace breast {

/// By its SOP class, whatever its name.
bool is_dicom_segmentation(const std::filesystem::path& file);

/// The volume that holds all frames, with the number of a segment in each of its voxels and 0 elsewhere;
/// a voxel of a fractional segmentation belongs to a segment by more than half, which its remark says. Slices without a segment
/// may be missing. Throws Error (input) for frames that are no volume, segments that overlap, and
/// pixels of another kind.
SegmentedVolume read_dicom_segmentation(const std::filesystem::path& file);

/// Writes the tissues that occur as a BINARY object of one bit per pixel, atomically. Segments are numbered
/// from 1 in the order of tissue codes, and labelled by their names (segments_of). It names no patient, as no
/// file of libbreast does; of a DICOM `scan` it has the study and the frame of reference, and refers to the
/// series and its instances (PS3.3 C.12.2). Throws Error (input) for slices beyond what DICOM allows.
void write_dicom_segmentation(const std::filesystem::path& file, const LabelVolume& labels,
                              const DicomReference& scan = {});

}  // namespace breast
