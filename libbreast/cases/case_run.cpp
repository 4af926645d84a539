// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/case_run.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <regex>
#include <sstream>

#include "cli/library_words.hpp"
#include "command/child.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// A reason is cut to this number of bytes: a longer line of a log is not a sentence.
constexpr std::size_t longest_reason = 2000;

bool from_make(const std::string& line) {
  return line.starts_with("make") || line.starts_with("set-up");
}

// Messages of programs begin with the name of the program: "forward: no body of this shape ...".
bool from_program(const std::string& line) {
  const std::size_t colon = line.find(": ");
  return colon != std::string::npos && colon > 0 &&
         line.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == colon;
}

std::string telling_line(const std::string& log) {
  std::istringstream in(log);
  std::string program, last;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("make") && line.find("No rule to make target") != std::string::npos)
      return line;
    if (!from_make(line) && from_program(line)) program = line;
    last = line;
  }
  return program.empty() ? last : program;
}

void remove_all(std::string& text, const std::string& part) {
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos;)
    text.erase(at, part.size());
}

/// An exclusive lock on a file, held until destruction. If another process holds the lock, the
/// constructor prints `says` and waits.
class FileLock {
 public:
  explicit FileLock(const fs::path& file, const std::string& says = "")
      : file_(open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ < 0) throw failed_error(file.string(), ": ", std::strerror(errno));
    if (flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    if (!says.empty()) dprintf(message_descriptor(), "%s\n", says.c_str());
    while (flock(file_, LOCK_EX) != 0)
      if (errno != EINTR) throw failed_error(file.string(), ": ", std::strerror(errno));
  }
  ~FileLock() { close(file_); }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int file_;
};

volatile std::sig_atomic_t stopped = 0;
constexpr std::array ending{SIGTERM, SIGHUP, SIGXCPU, SIGINT};

bool ended_by_signal(int exit_code) {
  return stopped != 0 || std::any_of(ending.begin(), ending.end(),
                                     [&](int number) { return exit_code == 128 + number; });
}

void say(const CaseRun& run, const std::string& status, const std::string& reason) {
  write_text(run.status, status + "\t" + reason + "\n");
}

// Runs the case and returns its exit code. The scan of a phantom is made first.
int run_commands(const CaseRun& run) {
  if (run.phantom) {
    const FileLock alone(run.status.parent_path() / ".phantoms.lock");
    std::vector<std::string> scan = run.command;
    scan.back() = "phantom-scan";
    if (const int code = run_child_into(scan, run.log); code != 0) return code;
  }
  return run_child_into(run.command, run.log);
}

}  // namespace

std::string reason_of(const std::string& log, const fs::path& runs) {
  std::string reason = telling_line(log).substr(0, longest_reason);
  std::replace(reason.begin(), reason.end(), '\t', ' ');
  reason = std::regex_replace(reason, std::regex(R"(^make(\[[0-9]+\])?: \*\*\* )"), "");
  if (const std::string stop = ".  Stop."; reason.ends_with(stop))
    reason.resize(reason.size() - stop.size());
  remove_all(reason, runs.string() + "/");
  reason = std::regex_replace(reason, std::regex(R"((^|[\] '",=:(])\.{0,2}/[^ '",=:)]*/)"), "$1");
  return std::regex_replace(reason, std::regex(R"(^No rule to make target '(.*)', needed by .*)"),
                            "'$1', which a setting names, does not exist");
}

bool run_case(const CaseRun& run) {
  const std::string name = run.status.stem();
  const FileLock alone(run.status.parent_path() / ("." + name + ".lock"),
                       "cohort: " + name + ": another process works on it; waiting for it");
  for (const int number : ending) std::signal(number, [](int) { stopped = 1; });
  say(run, "running", "");
  fs::remove(run.log);
  const int code = run_commands(run);
  if (ended_by_signal(code)) {
    say(run, "failed", "stopped by a signal: cancelled, out of its time, or interrupted");
    return false;
  }
  const std::string reason =
      code == 0 ? "" : reason_of(read_text(run.log), run.status.parent_path());
  if (code == 0)
    say(run, "done", "");
  else
    say(run, "failed", reason.empty() ? "nothing was said; see the log" : reason);
  return true;
}

bool is_done(const fs::path& status) {
  return fs::is_regular_file(status) && read_text(status).starts_with("done");
}

}  // namespace breast
