// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/last_words.hpp"

#include <errno.h>
#include <signal.h>
#include <unistd.h>

#include <cstring>
#include <exception>
#include <initializer_list>
#include <new>

#include "cli/library_words.hpp"
#include "core/temporary_folder.hpp"

namespace breast {

namespace {

pid_t program = 0;
volatile sig_atomic_t ended = 0;

[[noreturn]] void end_unhandled() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    end_with("out of memory");
  } catch (const std::exception& error) {
    end_with(error.what());
  } catch (...) {
  }
  end_with("unknown failure");
}

void end_crashed(int fault) {
  switch (fault) {
    case SIGSEGV:
      end_with(
          "crashed (invalid memory access): out of memory or stack space (ulimit -v, -s), "
          "or an error in this program");
    case SIGBUS:
      end_with("crashed (a file or the memory behind it became unavailable)");
    default:
      end_with("crashed (a library aborted): out of memory, or an error in this program");
  }
}

}  // namespace

void end_with(const char* reason) noexcept {
  // A child process that was forked to read or to draw prints nothing: its parent does.
  if (getpid() != program) _exit(1);
  ended = 1;
  const int user = message_descriptor();
  const auto put = [user](const char* part) {
    const ssize_t written = write(user, part, std::strlen(part));
    (void)written;
  };
  char line[256];
  copy_last_library_line(line, sizeof line);
  if (isatty(user) != 0) put("\r\033[K");  // in place of a progress bar
  put(program_invocation_short_name);
  put(": ");
  put(reason);
  if (line[0] != 0) {
    put(": ");
    put(line);
  }
  put("\n");
  remove_leftovers();
  _exit(1);
}

bool has_ended() noexcept {
  return ended != 0;
}

bool have_last_words() {
  program = getpid();
  std::set_terminate(end_unhandled);
  signal(SIGXFSZ, SIG_IGN);
#if !defined(__SANITIZE_ADDRESS__)         // which has words of its own
  alignas(16) static char stack[1 << 16];  // the usual one may be what is full
  stack_t other{};
  other.ss_sp = stack;
  other.ss_size = sizeof stack;
  sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = end_crashed;
  action.sa_flags = int(SA_ONSTACK | SA_RESETHAND | SA_NODEFER);
  for (const int fault : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL})
    sigaction(fault, &action, nullptr);
#endif
  return true;
}

}  // namespace breast
