// SPDX-License-Identifier: GPL-3.0-or-later
// A case of a cohort, run as a process: its status during and after the run, and the reason if it
// fails.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// The reason why a make failed, found in its output `log`: the file for which make has no rule;
/// otherwise the last message of a program; otherwise the last line. Folders are removed from it,
/// among them `runs`, so that the reason does not depend on the place where the case was run.
std::string reason_of(const std::string& log, const std::filesystem::path& runs);

struct CaseRun {
  /// RUNS/CASE.status, which contains "running", then "done" or "failed" with the reason.
  std::filesystem::path status;
  std::filesystem::path log;  ///< output of the commands
  /// True if the scan is a phantom's. Cases of one phantom share its scan, which only one of them
  /// may make.
  bool phantom = false;
  std::vector<std::string> command;  ///< make command of the case; its last word is the target
};
/// Runs the case and writes its outcome to the status file. Returns false if a signal stopped the
/// case, otherwise true, also if the case failed. Only one process at a time works on a case: a
/// second one waits for the first, because a cluster may start a task again before its first run
/// has ended. Throws Error (failed) if the lock file or the log cannot be opened.
bool run_case(const CaseRun& run);

/// True if the status file exists and says that the case is done.
bool is_done(const std::filesystem::path& status);

}  // namespace breast
