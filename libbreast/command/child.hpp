// SPDX-License-Identifier: GPL-3.0-or-later
// Execution of programs by `breast`: a tool replaces the process, make runs as a child.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// Replaces this process by `program words...`; returns only by throwing Error (failed).
[[noreturn]] void become(const std::filesystem::path& program,
                         const std::vector<std::string>& words);

/// Runs `words` (the program first, searched for in PATH) and waits. The child shares this
/// process's terminal and alone receives its interrupts, and ends when this process does. Returns
/// its exit code, or 128 plus the signal number if a signal ended it.
int run_child(const std::vector<std::string>& words);
/// The same, with the output written to the descriptors `out` and `err` (-1: to those of this
/// process).
int run_child_to(const std::vector<std::string>& words, int out, int err);
/// The same, with the output appended to the file `log`. Throws Error (failed) if it cannot be
/// opened.
int run_child_into(const std::vector<std::string>& words, const std::filesystem::path& log);

/// The same without showing the output, which is returned.
struct Captured {
  int exit_code = 0;
  std::string out, err;
};
Captured capture_child(const std::vector<std::string>& words);

}  // namespace breast
