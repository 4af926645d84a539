// SPDX-License-Identifier: GPL-3.0-or-later
// A case of a cohort as a process: its status while it runs and when it has ended, and why it failed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// Why a make failed, from what it printed: the file that make misses, else the last line a program printed before make's own
/// "*** [...] Error", else make's. Without folders: the reason is the same wherever the case was run.
std::string reason_of(const std::string& log, const std::filesystem::path& runs);

struct CaseRun {
  std::filesystem::path status;  ///< RUNS/CASE.status: "running", then "done", or "failed" and why
  std::filesystem::path log;     ///< what the commands print
  bool phantom = false;  ///< cases of one phantom share its scan, which only one of them may make
  std::vector<std::string> command;  ///< the make of the case; its last word is the target
};
/// Runs it and keeps the outcome in the status. False where a signal stopped it. One process a case: another waits until it has
/// ended, because a task that a cluster starts again must not meet itself.
bool run_case(const CaseRun& run);

/// Whether a status says done.
bool is_done(const std::filesystem::path& status);

}  // namespace breast
