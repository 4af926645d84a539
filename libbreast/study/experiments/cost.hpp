// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of error against run time and mesh, from solves on several meshes with several elements
// and solvers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/cells.hpp"
#include "study/shape.hpp"
#include "study/stage_report.hpp"

namespace breast {

/// The estimated error in mm of the shape found by the second of two successive solves: the
/// stress-free shape has an error of its own, which is added. No value if either error is not
/// estimated.
std::optional<double> carried_estimate(const StageReport& backward, const StageReport& forward);

/// One row per point ELEMENT-TEMPLATE-N[-SOLVER] of the variants FOLDER/POINT.
/// error_mm: the largest distance of tumour or nipple from the point `finest`; estimate_mm: the
/// solver's own estimate; "-": no solution, or no estimate.
Table cost_table(const std::filesystem::path& folder, const std::string& finest,
                 const std::vector<std::string>& points, const ShapeReader& read);

/// One discretisation tried by ACCURACY, from the same files: its estimated errors, its cost, and
/// whether both errors are at most `wanted` mm. 8-node elements estimate their own error. The error
/// of 27-node elements is assumed to be at most the distance to the previous discretisation with
/// 27-node elements, `coarser` ("" for the first of them, which only starts the comparison). No
/// value if the point has no solution.
std::optional<Row> accuracy_row(const std::filesystem::path& folder, const std::string& point,
                                const std::string& coarser, double wanted, const ShapeReader& read);

/// Convergence of compressed shapes with the mesh. One row per mesh, the variant FOLDER/N with its
/// stages cc and mlo: distance in mm of tumour and nipple from those of the last N, the solver's
/// own error estimate at the tumour, mm, forces of paddle and detector, N, and reduction of the
/// thickness, per cent. "-": not reached.
Table convergence_table(const std::filesystem::path& folder, const std::vector<std::string>& meshes,
                        const ShapeReader& read);

}  // namespace breast
