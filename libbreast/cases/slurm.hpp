// SPDX-License-Identifier: GPL-3.0-or-later
// A cohort on Slurm: a job array over its cases (several arrays if there are more cases than the
// site's MaxArraySize), followed by a job that makes the table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/cohort/cohort_table.hpp"

namespace breast {

/// A submission to Slurm. If `time` or `memory` is empty, it is derived from measured costs.
struct SlurmRequest {
  std::filesystem::path runs;        ///< of the cohort; contains its list .cases
  std::filesystem::path cohort;      ///< folder of the case files
  std::filesystem::path program;     ///< the tool `cases`, which runs a task
  std::vector<std::string> command;  ///< make command of a case, without the case's own settings
  /// Options of sbatch, empty if not given: `time` in minutes or in the notation of Slurm, `memory`
  /// in MB, `options` separated by blanks.
  std::string partition, account, time, memory, options;
  int cores = 1;               ///< per case
  bool resume = false;         ///< submits only the cases that are missing or out of date
  double elements = 16;        ///< ELEMENTS of every case, unless its case file asks for more
  std::string element;         ///< q1p0 or q2p1; if empty, q1p0
  std::filesystem::path cost;  ///< table of assumed costs, pipelines/cohort-cost.tsv
};

/// One line of RUNS/.cases; `kind` is scan or phantom.
struct SlurmCase {
  std::string name, file, kind;
};
/// Reads a list in the format of RUNS/.cases. Throws Error (input) naming a line without three
/// cells.
std::vector<SlurmCase> slurm_cases(const std::filesystem::path& list);

/// The cost, in minutes and MB, of the largest mesh that the request or a case file asks for.
/// Throws Error (input) if no table of costs contains the element.
CaseCost dearest_case(const SlurmRequest& request, const std::vector<SlurmCase>& cases);
/// The script of the job array. Every submission has its own list of cases in `folder`
/// (RUNS/.slurm/N), so that a later submission does not change what the tasks of an earlier one
/// read.
std::string array_script(const SlurmRequest& request, const std::filesystem::path& folder,
                         const CaseCost& cost);
/// The cases to run: all cases or, with `resume`, those without a result and those that make
/// considers out of date.
std::vector<SlurmCase> wanted_cases(const SlurmRequest& request);

/// The options and the script that sbatch would receive, as text.
std::string slurm_plan(const SlurmRequest& request);
/// Submits the cohort and returns a message with the numbers of the jobs and their time and memory.
/// Throws Error (failed) if sbatch is not found or refuses a job.
std::string submit_to_slurm(const SlurmRequest& request);
/// Called in a task of the array: runs the case whose line in FOLDER/cases, counted from 0, is
/// SLURM_ARRAY_TASK_ID + `offset`. Returns the text of its status file. Throws Error (input) if
/// there is no such case, and Error (failed) if the case does not end as done.
std::string run_slurm_task(const std::filesystem::path& folder, int offset);
/// Called in the last job: makes the table of the cohort and returns the exit code of make.
int run_slurm_table(const std::filesystem::path& folder, const std::string& cohort);

}  // namespace breast
