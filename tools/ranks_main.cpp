// SPDX-License-Identifier: GPL-3.0-or-later
#include "ranks_main.hpp"

#include <errno.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/last_words.hpp"
#include "cli/library_words.hpp"
#include "core/parallel.hpp"
#include "core/temporary_folder.hpp"

namespace breast {

namespace {

bool starting = false;  ///< MPI

bool asks(int argc, char** argv) {
  return std::any_of(argv + std::min(argc, 1), argv + argc, [](const char* argument) {
    const std::string_view text(argument);
    return text == "--version" || text.substr(0, 6) == "--help";
  });
}

// Only the root writes a report.
std::vector<char*> without_report(int argc, char** argv) {
  std::vector<char*> kept;
  for (int i = 0; i < argc; ++i) {
    const std::string_view text(argv[i]);
    if (text == "--report") {
      ++i;
    } else if (text.substr(0, 9) != "--report=") {
      kept.push_back(argv[i]);
    }
  }
  return kept;
}

// Discards all output of this process from here on, except on the returned descriptor.
int fall_silent() {
  const int stderr_before = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
  return stderr_before;
}

}  // namespace

int ranks_main(Tool& tool, int argc, char** argv,
               const std::function<void(Run&, const Ranks&)>& body) {
  if (asks(argc, argv)) return tool.main(argc, argv, [](Run&) {});
  // This precedes the start of MPI, because it may restart the program.
  sleep_when_waiting(argv);
  std::optional<RankSession> session;
  try {
    const LibraryWords held;  // what Open MPI says of its failures is many lines
    starting = true;
    session.emplace();
    starting = false;
  } catch (const Error& error) {
    starting = false;
    return tool.main(argc, argv, [&error](Run&) { throw Error(error); });
  }
  const Ranks ranks;
  std::vector<char*> arguments(argv, argv + argc);
  int voice = STDERR_FILENO;
  if (!ranks.root()) {
    arguments = without_report(argc, argv);
    voice = fall_silent();
  }
  bool entered = false;
  const int code = tool.main(int(arguments.size()), arguments.data(), [&](Run& run) {
    entered = true;
    if (!ranks.all(true)) {
      throw failed_error(
          "some of the processes refuse the files that others accept; run where all "
          "see the same folders");
    }
    // The ranks share the machine's threads; PETSc uses none.
    set_threads(std::max(1, threads() / ranks.size()));
    try {
      body(run, ranks);
    } catch (const SharedError&) {
      throw;
    } catch (const std::exception& error) {
      if (ranks.size() == 1) throw;
      dprintf(voice, "%s: rank %d: %s\n", argv[0], ranks.rank(), error.what());
      ranks.abort(1);
    }
  });
  if (!entered) ranks.all(false);
  return code;
}

}  // namespace breast

// Open MPI ends a process in which it cannot start by this function, after words that are held back.
extern "C" [[noreturn]] void _exit(int code) {
  if (breast::starting && !breast::has_ended()) {
    dprintf(breast::message_descriptor(),
            "%s: MPI cannot start: is there space in TMPDIR, and memory?\n",
            program_invocation_short_name);
    breast::remove_leftovers();
    code = 1;
  }
  syscall(SYS_exit_group, code);
  __builtin_unreachable();
}
