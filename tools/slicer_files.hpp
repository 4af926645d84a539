// SPDX-License-Identifier: GPL-3.0-or-later
// The output files of export-slicer.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/tool.hpp"
#include "export/slicer/scene.hpp"
#include "slicer_run.hpp"

namespace breast {

/// Writes the scan (16 bits if its values are integers), labels, shapes, landmarks and curves into
/// `folder` and returns them as items of the scene.
std::vector<SceneItem> write_shapes(const std::filesystem::path& folder, const SlicerRun& run,
                                    const History& history);

struct FieldOptions {
  double spacing =
      0;  ///< mm; 0 for the scan's grid with slices subdivided until they are at most 1.25 mm apart
  double margin = 10;  ///< mm around both shapes
};

/// Writes both fields of every state other than prone and stress-free, their parts, and the scan
/// warped to supine. Errors and costs are added to the report and printed, one row per field.
std::vector<SceneItem> write_fields(const std::filesystem::path& folder,
                                    const SlicerRun& slicer_run, const FieldOptions& options,
                                    Run& run);

}  // namespace breast
