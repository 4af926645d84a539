// SPDX-License-Identifier: GPL-3.0-or-later
// A cohort on Slurm: one job array over its cases, several where the site's MaxArraySize is smaller, then a job that makes the
// table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/cohort/cohort_table.hpp"

namespace breast {

/// What sbatch is asked for; time and memory come from measured cost where they are empty.
struct SlurmRequest {
  std::filesystem::path
      runs;  ///< the cohort's, with .cases (CASE, FILE, KIND a line)
  std::filesystem::path cohort;      ///< the folder of its case files
  std::filesystem::path program;     ///< that runs a task: cases
  std::vector<std::string> command;  ///< the make of a case but for its own settings
  std::string partition, account, time, memory, options;
  int cores = 1;
  bool resume = false;         ///< only the cases that are missing or out of date
  double elements = 16;        ///< of every case, unless its file asks for more
  std::string element;         ///< q1p0 where empty
  std::filesystem::path cost;  ///< pipelines/cohort-cost.tsv
};

/// One line of .cases.
struct SlurmCase {
  std::string name, file, kind;
};
std::vector<SlurmCase> slurm_cases(const std::filesystem::path& list);

/// The largest mesh that the request or a case file asks for, and its cost.
CaseCost dearest_case(const SlurmRequest& request, const std::vector<SlurmCase>& cases);
/// The script of the array. Every submission keeps its own list in `folder` (RUNS/.slurm/N), so that a second one does not change
/// what the tasks of the first will read.
std::string array_script(const SlurmRequest& request, const std::filesystem::path& folder,
                         const CaseCost& cost);
/// Cases to run: all, or with `resume` those without a result, and those whose make has something to do.
std::vector<SlurmCase> wanted_cases(const SlurmRequest& request);

/// What sbatch would be given, as text.
std::string slurm_plan(const SlurmRequest& request);
/// Gives it to Slurm; what to say of it. Throws Error (failed) when sbatch is not there or takes no more.
std::string submit_to_slurm(const SlurmRequest& request);
/// Within the array: runs the case of this task, the line of FOLDER/cases that SLURM_ARRAY_TASK_ID and the offset name. The case's
/// status; throws Error (failed) when it is not done.
std::string run_slurm_task(const std::filesystem::path& folder, int offset);
/// Within the last job: makes the table.
int run_slurm_table(const std::filesystem::path& folder, const std::string& cohort);

}  // namespace breast
