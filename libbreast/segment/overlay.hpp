// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of slices with contours, for judging a segmentation.
#pragma once

#include <filesystem>

#include "image/label_volume.hpp"

namespace breast {

/// PNG: a row of axial, one of sagittal and one of coronal slices through the breast with the
/// outlines of breast (yellow), fibroglandular tissue (red), chest wall (green: sure, orange:
/// unsure), and the nipple (blue cross). `scan` may lie on a finer grid. Throws Error (failed) when
/// the disk does.
void write_overlay(const std::filesystem::path& file, const Volume<float>& scan,
                   const LabelVolume& labels);

}  // namespace breast
