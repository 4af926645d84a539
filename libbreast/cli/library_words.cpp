// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/library_words.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "cli/last_words.hpp"

namespace breast {

namespace {

constexpr int none = -1;
std::atomic<int> user = none, words = none;  ///< descriptors; none: stderr is what it was

void at_exit() {
  if (user == none) return;
  end_with("a library ended the program");
}

// A buffer of 64 kB that does not grow: a write beyond it fails, which does no harm.
int little_memory() {
  constexpr off_t size = 1 << 16;
  const int file = memfd_create("words of libraries", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file < 0) return none;
  if (ftruncate(file, size) == 0 && fcntl(file, F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SHRINK) == 0)
    return file;
  close(file);
  return none;
}

}  // namespace

LibraryWords::LibraryWords() {
#if !defined(__SANITIZE_ADDRESS__)
  [[maybe_unused]] static const int registered = std::atexit(at_exit);
  const int memory = little_memory();
  const int kept = memory == none ? none : fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  if (kept == none) {
    if (memory != none) close(memory);
    return;
  }
  std::fflush(stderr);
  dup2(memory, STDERR_FILENO);
  words = memory;
  user = kept;
#endif
}

LibraryWords::~LibraryWords() {
  if (user == none) return;
  std::fflush(stderr);
  const int kept = user.exchange(none);
  dup2(kept, STDERR_FILENO);
  close(kept);
  close(words.exchange(none));
}

int message_descriptor() noexcept {
  const int kept = user;
  return kept == none ? STDERR_FILENO : kept;
}

void copy_last_library_line(char* text, std::size_t size) noexcept {
  text[0] = 0;
  if (words == none || size == 0) return;
  const off_t end = lseek(words, 0, SEEK_CUR);  // shared with stderr
  char last[512];
  const off_t from = std::max<off_t>(0, end - off_t(sizeof last));
  ssize_t count = end > 0 ? pread(words, last, std::size_t(end - from), from) : 0;
  const auto blank = [](char c) { return c == '\n' || c == ' ' || c == '\r'; };
  while (count > 0 && blank(last[count - 1])) --count;
  ssize_t start = count;
  while (start > 0 && last[start - 1] != '\n') --start;
  std::size_t length = 0;
  for (ssize_t k = start; k < count && length + 1 < size; ++k) {
    const auto byte = static_cast<unsigned char>(last[k]);
    text[length++] = byte < ' ' || byte == 0x7f ? '?' : last[k];
  }
  text[length] = 0;
}

}  // namespace breast
