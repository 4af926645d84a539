// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/sibling.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "core/temporary_folder.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

fs::path sibling(const std::string& tool) {
  return fs::read_symlink("/proc/self/exe").parent_path() / tool;
}

// In the child: only calls that are safe between fork and exec.
[[noreturn]] void become(char* const* argv, pid_t parent, int nowhere) {
  die_with_parent(parent, SIGTERM);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  execv(argv[0], argv);
  _exit(127);
}

/// Exit code, or -1 when a signal ended it.
int run_silently(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) become(argv.data(), parent, nowhere);
  const int reason = errno;
  if (nowhere >= 0) close(nowhere);
  if (child < 0) throw failed_error(words[0], " could not be started: ", std::strerror(reason));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

void require_sibling(const std::string& tool, const std::string& what,
                     const std::string& packages) {
  if (access(sibling(tool).c_str(), X_OK) == 0) return;
  throw input_error(
      what, " needs the program ", sibling(tool).string(),
      ", which is not built: cmake --preset release && cmake --build build/release --target ", tool,
      " (", packages, ")");
}

Report run_sibling(const std::string& tool, const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  const fs::path report_file = folder / "report.json";
  std::vector<std::string> words{sibling(tool).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.insert(words.end(), {"--report", report_file.string()});
  const int code = run_silently(std::move(words));
  if (!fs::exists(report_file))
    throw failed_error(tool, " ended with code ", code, " and without a report");
  Report report = Report::parse(read_text(report_file), tool + "'s report");
  if (code == 0) return report;
  const ErrorKind kind = code == 2 ? ErrorKind::input : ErrorKind::failed;
  throw Error(kind, message(tool, ": ", report.text("reason")));
}

}  // namespace breast
