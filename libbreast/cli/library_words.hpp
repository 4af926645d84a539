// SPDX-License-Identifier: GPL-3.0-or-later
// Suppression of what libraries print on stderr while a tool runs; the user gets a single line of
// the tool.
#pragma once

#include <cstddef>

namespace breast {

/// While it lives, stderr leads nowhere but into 64 kB of memory; what a tool says goes to message_descriptor(). When
/// a library ends the program (libgomp does, out of memory), its last line is shown as the reason. Not under a
/// sanitizer, whose reports are wanted. One at a time.
class LibraryWords {
 public:
  LibraryWords();
  ~LibraryWords();
  LibraryWords(const LibraryWords&) = delete;
  LibraryWords& operator=(const LibraryWords&) = delete;
};

/// Where the user reads: stderr as it was when the program started.
int message_descriptor() noexcept;

/// Copies the last line that a library printed, control characters as '?'; an empty text when there is none. It may be
/// called in a signal handler.
void copy_last_library_line(char* text, std::size_t size) noexcept;

}  // namespace breast
