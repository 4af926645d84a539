// SPDX-License-Identifier: GPL-3.0-or-later
// Solves the meshes of a ladder, the cheapest first, until the estimated error is small enough.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

struct Ladder {
  std::filesystem::path run;  ///< folder of the case
  std::string wanted_mm;      ///< largest accepted estimate of the error, mm
  /// Meshes ELEMENT-TEMPLATE-N of the ladder, which are rows of pipelines/studies/cost.tsv.
  std::vector<std::string> points;
  std::vector<std::string> tabulate;  ///< command `tabulate`, whose kind `accuracy` judges a point
  std::vector<std::string> make;      ///< command that solves a point, without its target
};
/// Writes RUN/accuracy.tsv, a table of the points tried, and RUN/accuracy.mk, the ELEMENTS and
/// ELEMENT chosen: those of the first point that meets `wanted_mm`, or otherwise of the last point
/// that has a solution. Returns the table, followed by a remark if no point meets `wanted_mm`.
/// Throws Error (not converged) if no point has a solution, and Error (failed) if a command fails.
std::string climb(const Ladder& ladder);

}  // namespace breast
