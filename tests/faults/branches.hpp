// SPDX-License-Identifier: GPL-3.0-or-later
// One run of a tool that branches (shim.cpp): what it does before an output call (the first, as a rule)
// is done once for all failures that are tried there, each in a process forked from it.
#pragma once

#include <poll.h>
#include <signal.h>
#include <sys/stat.h>

#include <cstdlib>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/run_tool.hpp"

namespace breast::faults {

/// What waits in a pipe that is read without blocking.
inline std::string text_in(int pipe) {
  char text[4096];
  const ssize_t size = read(pipe, text, sizeof text);
  return {text, std::size_t(std::max<ssize_t>(size, 0))};
}

class BranchedRun {
 public:
  struct Branch {
    std::string at;        ///< "output" or "allocation"
    long allocations = 0;  ///< up to here
  };

  /// Starts `tool words` in `folder` under the environment of the shim, to branch before these
  /// allocations (in order) and before the `output`-th output call (from 1). Orders and answers go
  /// through two pipes in the folder `control`.
  BranchedRun(const std::string& tool, const std::vector<std::string>& words,
              const std::filesystem::path& folder, const std::filesystem::path& control, int output,
              const std::vector<long>& allocations = {})
      : folder_(folder) {
    for (const char* name : {"orders", "answers"}) {
      std::filesystem::remove(control / name);
      if (mkfifo((control / name).c_str(), 0600) != 0) throw failed_error("mkfifo ", name);
    }
    // Both ways, so that neither opening waits for the other end.
    orders_ = open((control / "orders").c_str(), O_RDWR | O_CLOEXEC);
    answers_ = open((control / "answers").c_str(), O_RDWR | O_CLOEXEC);
    if (pipe2(said_, O_CLOEXEC | O_NONBLOCK) != 0) throw failed_error("no pipe");
    std::string where = control.string() + ':' + std::to_string(output);
    for (const long n : allocations) where += ',' + std::to_string(n);
    child_ = fork();
    if (child_ == 0) {
      setenv("BREAST_FAULT", (tool + ":").c_str(), 1);
      setenv("BREAST_FAULT_FORK", where.c_str(), 1);
      dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
      dup2(said_[1], STDERR_FILENO);  // of all that is forked: a pipe, which has no limit of size
      become_tool(tool, words, folder_);
    }
  }
  BranchedRun(const BranchedRun&) = delete;
  BranchedRun& operator=(const BranchedRun&) = delete;
  ~BranchedRun() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
    for (const int file : {orders_, answers_, said_[0], said_[1]}) close(file);
  }

  /// The branch it is at, or reaches next; nothing when it has ended before.
  std::optional<Branch> reached() {
    const std::string line = answer();
    const std::size_t blank = line.find(' ');
    if (blank == std::string::npos) return {};
    return Branch{line.substr(0, blank), std::stol(line.substr(blank + 1))};
  }
  /// What becomes of it from here with that plan (PROGRAM:KIND:N[:ERRNO[+]]) and files no longer
  /// than `bytes` (-1: any).
  ToolResult attempt(const std::string& plan, long bytes = -1) {
    order("try " + plan + ' ' + std::to_string(bytes));
    const std::string line = answer();
    if (!line.starts_with("status ")) throw failed_error("a run that branches ended: ", line);
    const int status = std::stoi(line.substr(7));
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, printed(), text_in(said_[0])};
  }
  void go() { order("go"); }

 private:
  void order(const std::string& line) {
    const std::string text = line + '\n';
    if (write(orders_, text.data(), text.size()) != ssize_t(text.size())) {
      throw failed_error("no order reaches a run that branches");
    }
  }
  // Empty when the program has ended.
  std::string answer() {
    constexpr int wait_ms = 200;
    std::string line;
    for (char c = 0;;) {
      pollfd ready{answers_, POLLIN, 0};
      if (poll(&ready, 1, wait_ms) > 0) {
        if (read(answers_, &c, 1) != 1 || c == '\n') return line;
        line += c;
      } else if (waitpid(child_, nullptr, WNOHANG) == child_) {
        child_ = 0;
        return "";
      }
    }
  }
  std::string printed() const {
    const std::filesystem::path file = folder_ / ".stdout";
    const std::string text = read_text(file);
    std::filesystem::remove(file);
    return text;
  }

  std::filesystem::path folder_;
  int orders_ = -1, answers_ = -1, said_[2] = {-1, -1};
  pid_t child_ = 0;
};

}  // namespace breast::faults
