// SPDX-License-Identifier: GPL-3.0-or-later
// Up a ladder of meshes, cheapest first, until the estimated error is met.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

struct Ladder {
  std::filesystem::path run;
  std::string wanted_mm;
  std::vector<std::string> points;    ///< ELEMENT-TEMPLATE-N, rows of pipelines/studies/cost.tsv
  std::vector<std::string> tabulate;  ///< the command that judges a point (its kind accuracy)
  std::vector<std::string> make;      ///< the command that solves one
};
/// Writes RUN/accuracy.tsv, what was tried, and RUN/accuracy.mk, the ELEMENTS and ELEMENT chosen: the first rung that is good
/// enough, else the last that has a solution. What there is to say; throws Error (not converged) where none could be solved.
std::string climb(const Ladder& ladder);

}  // namespace breast
