// SPDX-License-Identifier: GPL-3.0-or-later
// Suppression of what libraries print on stderr while a tool runs; the user gets a single line of
// the tool.
#pragma once

#include <cstddef>

namespace breast {

/// During its lifetime stderr is redirected to 64 kB of memory; messages of the tool go to
/// message_descriptor(). If a library ends the program (as libgomp does when out of memory), its
/// last line is shown as the reason. Inactive under a sanitizer, whose reports are needed. Only one
/// instance at a time.
class LibraryWords {
 public:
  LibraryWords();
  ~LibraryWords();
  LibraryWords(const LibraryWords&) = delete;
  LibraryWords& operator=(const LibraryWords&) = delete;
};

/// Descriptor of the user's stderr, as it was when the program started.
int message_descriptor() noexcept;

/// Copies the last line that a library printed, with control characters replaced by '?'; an empty
/// text if there is none. A signal handler may call it.
void copy_last_library_line(char* text, std::size_t size) noexcept;

}  // namespace breast
