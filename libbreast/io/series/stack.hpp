// SPDX-License-Identifier: GPL-3.0-or-later
// Images of a DICOM series that are one volume.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/series/image.hpp"

namespace breast {

/// Slices of one volume: a whole series, or one of its time points, kinds of image or slabs.
struct DicomStack {
  std::vector<DicomImage> slices;  ///< by position along the normal
  int files = 0;
  int repeats = 0;               ///< images that another one repeats, of a series at its first part
  int time = 1, times = 1;       ///< the how manyeth of how many time points of its series
  int kind = 1, kinds = 1;       ///< and of how many kinds of image (parts of the signal, echoes)
  bool of_side = false;          ///< one of two sagittal slabs
  std::optional<Side> side;      ///< the breast that it shows, if it shows one
  std::string patient_position;  ///< of all slices: "HFP", "HFP/HFS" if they differ
  /// Why it is no volume, as one line; "" if it is one.
  std::string fault;

  const DicomImage& first() const { return slices.front(); }
  double thickness() const;  ///< mm from slice to slice
  Vec3 extent() const;       ///< mm along rows, columns and normal
  /// "40 files of 512 x 512 pixels, series number 3". Not its description, in which anything may
  /// stand, also names: messages and reports are sent to others.
  std::string label() const;
};

/// The stacks of all images, in the order of series number and series UID. Images at one place are told
/// apart by their marks: a mark, or two together, that takes as many values as there are images at a
/// place. `where` begins faults that no single file has.
std::vector<DicomStack> stacks_of(std::vector<DicomImage> images, const std::string& where);

}  // namespace breast
