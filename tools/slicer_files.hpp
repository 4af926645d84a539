// SPDX-License-Identifier: GPL-3.0-or-later
// What export-slicer writes, file by file.
#pragma once

#include <filesystem>
#include <vector>

#include "cli/tool.hpp"
#include "slicer/scene.hpp"
#include "slicer_run.hpp"

namespace breast {

/// Scan (16 bits where its values are whole numbers), labels, shapes, landmarks and curves into `folder`; returns them
/// as items of the scene.
std::vector<SceneItem> write_shapes(const std::filesystem::path& folder, const SlicerRun& run,
                                    const History& history);

struct FieldOptions {
  double spacing =
      0;  ///< mm; 0: the scan's grid, slices divided until they are at most 1.25 mm apart
  double margin = 10;  ///< mm round both shapes
};

/// Both fields of every state that is neither prone nor stress-free, their parts, and the scan warped to supine;
/// errors and costs go to the report and, a row a field, to stdout.
std::vector<SceneItem> write_fields(const std::filesystem::path& folder,
                                    const SlicerRun& slicer_run, const FieldOptions& options,
                                    Run& run);

}  // namespace breast
