// SPDX-License-Identifier: GPL-3.0-or-later
// A one-line message and exit code 1 for failures that do not reach the handlers of Tool::main.
#pragma once

namespace breast {

/// From now on a failure that nobody catches (an exception outside Tool::main, in a thread of OpenMP or in a
/// destructor) and a crash (of a library that does not mind a failed allocation, or of a stack that is full) end the
/// program with one line on stderr and exit code 1, not with a signal; files and folders of temporary results are
/// removed where that is safe. A write beyond a limit on file sizes (ulimit -f) is an error like a full disk.
/// True, so that a static variable can call it before main.
bool have_last_words();

/// Says `NAME: reason` (and the last line a library printed), removes the folders of temporary results, ends the
/// process with exit code 1. Neither allocates nor locks.
[[noreturn]] void end_with(const char* reason) noexcept;

}  // namespace breast
