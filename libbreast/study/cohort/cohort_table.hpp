// SPDX-License-Identifier: GPL-3.0-or-later
// The cases of a cohort as a table: what became of each, what asks for a look, what it cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/warnings.hpp"

namespace breast {

struct CohortCase {
  std::string name;    ///< of its folder below the cohort's
  std::string status;  ///< done or failed
  std::string reason;  ///< of a failure
};
/// RUNS/.cases (case, file, kind a line) and RUNS/CASE.status: "done", or "failed" and why; "running" and none are failures too.
std::vector<CohortCase> read_cases(const std::filesystem::path& runs);

/// What of a finished or broken-off case asks for a look: warnings, segment's own grades below 0.5, poor elements, views that did
/// not converge, motion (motion.tsv) farther than two standard deviations from the mean of living women.
std::vector<std::string> looks(const std::filesystem::path& run, const std::vector<Advice>& advice,
                               const Table& women);
/// The last of them: the first quantity of the table that is so far away, and how many more.
std::string far_motion(const Table& motion, const Table& women);

/// A row a case, failures first.
Table cohort_table(const std::filesystem::path& runs, const std::vector<CohortCase>& cases,
                   const std::vector<Advice>& advice, const Table& women);
/// What the stages of every case took, each as it last ran.
Table cohort_cost(const std::filesystem::path& runs, const std::vector<CohortCase>& cases);

/// Minutes and MB to ask a cluster for, of one case.
struct CaseCost {
  int minutes = 0, memory_mb = 0;
  std::string source;
};
/// Three times, and one and a half times, what was measured: the dearest case of `measured` (cohort_cost, at least three cases with
/// CPU time) on `cores`, else a row of `assumed` for the element, on larger meshes with the fourth power and the cube of ELEMENTS.
/// Throws Error (input) where neither knows the element.
CaseCost case_cost(const Table* measured, const Table& assumed, int cores,
                   const std::string& element, double size);

}  // namespace breast
