// SPDX-License-Identifier: GPL-3.0-or-later
// Execution in a child process, for libraries that may crash, hang or use too much memory on a
// damaged file.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>

namespace breast {

/// Runs `work` in a child process with limits on time and memory and without output, and returns
/// the bytes that `work` returned. An Error of the child is thrown here with the same message and
/// kind; lack of memory, a crash of the child and a run time of more than `seconds` become Error
/// (input) beginning with `name`. Nothing else that the child does affects this process.
/// `memory_mb` is the memory that the child may use in addition to that of this process. `cpu_seconds`
/// limits its processor time, which unlike `seconds` does not depend on other work of the machine.
std::string in_guarded_child(const std::string& name, const std::function<std::string()>& work,
                             double seconds = 300, double memory_mb = 3072,
                             double cpu_seconds = 300);

/// In any child, after fork: it is sent `signal` when its parent ends, and ends at once if the parent has already ended.
/// `parent` is the parent's getpid(), taken before fork. Safe between fork and exec.
void die_with_parent(pid_t parent, int signal);

}  // namespace breast
