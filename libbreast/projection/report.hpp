// SPDX-License-Identifier: GPL-3.0-or-later
// Report entries and doubts of project-mammogram.
#pragma once

#include "core/report.hpp"
#include "projection/projection.hpp"

namespace breast {

/// Reports image, volumes and landmarks under the keys of docs/file-formats.md (volumes_ml,
/// thickness_mm, landmarks).
void write_report(const HexMesh& mesh, const Mammogram& image, const ProjectionReport& projection,
                  Report& report);
/// Throws Error (input) if most of the tissue lies outside the breast of the labels in this file.
void refuse_foreign_labels(const ProjectionReport& projection, const std::string& labels);
/// Doubts about landmarks behind the posterior edge of the image, and about tissue in voxels
/// without breast label.
std::vector<std::string> doubts(const HexMesh& mesh, const Mammogram& image,
                                const ProjectionReport& projection);

}  // namespace breast
