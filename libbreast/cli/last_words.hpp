// SPDX-License-Identifier: GPL-3.0-or-later
// A one-line message and exit code 1 for failures that do not reach the handlers of Tool::main.
#pragma once

namespace breast {

/// Installs handlers, so that uncaught failures (an exception outside Tool::main, in an OpenMP
/// thread or in a destructor) and crashes (of a library that ignores a failed allocation, or by a
/// stack overflow) end the program with one line on stderr and exit code 1 instead of a signal;
/// temporary files and folders are removed where that is safe. A write beyond a limit on file sizes
/// (ulimit -f) becomes an error like a full disk. Returns true, so that a static variable can call
/// it before main.
bool have_last_words();

/// Prints `NAME: reason` and the last line that a library printed, removes temporary folders, and
/// ends the process with exit code 1. Neither allocates nor locks.
[[noreturn]] void end_with(const char* reason) noexcept;
/// True once end_with has printed the last line of this process.
bool has_ended() noexcept;

}  // namespace breast
