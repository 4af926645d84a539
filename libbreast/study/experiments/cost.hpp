// SPDX-License-Identifier: GPL-3.0-or-later
// Error against run time and mesh: what solves on several meshes, elements and solvers say and cost.
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

/// mm that two solves one after the other say of the second's shape: its stress-free shape has an error of its own, which it
/// carries along. Nothing when either is not estimated.
std::optional<double> carried_estimate(const StageReport& backward, const StageReport& forward);

/// A row a point ELEMENT-TEMPLATE-N[-SOLVER] of the variants FOLDER/POINT (study/places.hpp). error_mm: largest distance of
/// tumour or nipple to the point `finest`; estimate_mm: what the solves themselves said; "-": no solution or not estimated.
Table cost_table(const std::filesystem::path& folder, const std::string& finest,
                 const std::vector<std::string>& points, const ShapeReader& read);

/// A rung of the ladder of meshes of ACCURACY, from the same files: its estimated errors, cost, and whether both errors are
/// at most `wanted` mm. 8-node elements say their error themselves; of 27-node ones it is taken to be at most the distance to
/// the rung of 27-node elements before, `coarser` ("": the first of them, which only starts the comparison). Nothing where
/// the point has no solution.
std::optional<Row> accuracy_row(const std::filesystem::path& folder, const std::string& point,
                                const std::string& coarser, double wanted, const ShapeReader& read);

/// How compressed shapes converge with the mesh: a row a mesh, the variant FOLDER/N with its stages cc and mlo: distance of tumour and nipple to
/// those of the last N, mm, the forces of paddle and detector, and the solve's own estimate at the tumour. "-": not reached.
Table convergence_table(const std::filesystem::path& folder, const std::vector<std::string>& meshes,
                        const ShapeReader& read);

}  // namespace breast
