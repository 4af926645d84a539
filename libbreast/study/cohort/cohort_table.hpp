// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of the cases of a cohort: the result of each case, what should be checked, and its cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "study/warnings.hpp"

namespace breast {

struct CohortCase {
  std::string name;    ///< name of its folder in the folder of the cohort
  std::string status;  ///< done or failed
  std::string reason;  ///< reason of a failure
};
/// Reads RUNS/.cases (one line per case with its name, file and kind) and RUNS/CASE.status: "done",
/// or "failed" with the reason. "running" and a missing status count as failures.
std::vector<CohortCase> read_cases(const std::filesystem::path& runs);

/// The properties of a case, finished or interrupted, that should be checked: warnings, quality
/// scores of segment below 0.5, poor elements, views that did not converge, and motion (motion.tsv)
/// more than two standard deviations from the mean of living women.
std::vector<std::string> looks(const std::filesystem::path& run, const std::vector<Advice>& advice,
                               const Table& women);
/// The entry for motion: the first quantity of the table that is that far away, and the number of
/// the others.
std::string far_motion(const Table& motion, const Table& women);

/// One row per case, failures first.
Table cohort_table(const std::filesystem::path& runs, const std::vector<CohortCase>& cases,
                   const std::vector<Advice>& advice, const Table& women);
/// The cost of the stages of every case, each from its last run.
Table cohort_cost(const std::filesystem::path& runs, const std::vector<CohortCase>& cases);

/// The minutes and MB to request from a cluster for one case.
struct CaseCost {
  int minutes = 0, memory_mb = 0;
  std::string source;
};
/// Three times the measured time and one and a half times the measured memory. The measurement is
/// that of the most expensive case of `measured` (cohort_cost, at least three cases with CPU time)
/// on `cores`; otherwise it is the row of `assumed` for the element, extrapolated to larger meshes
/// with the fourth power (time) and the cube (memory) of ELEMENTS. Throws Error (input) if neither
/// table contains the element.
CaseCost case_cost(const Table* measured, const Table& assumed, int cores,
                   const std::string& element, double size);

}  // namespace breast
