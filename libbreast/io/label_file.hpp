// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of a LabelVolume as a VTKHDF ImageData file (schema "labels/1"), with HDF5
// only.
#pragma once

#include <filesystem>

#include "image/label_volume.hpp"

namespace breast {

/// Throws Error (input) naming file, dataset, index, value and bound.
LabelVolume read_labels(const std::filesystem::path& file);
void write_labels(const std::filesystem::path& file, const LabelVolume& labels);

}  // namespace breast
