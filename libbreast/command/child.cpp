// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/child.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "core/temporary_folder.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

// In the child: only calls that are safe between fork and exec.
[[noreturn]] void begin_child(char* const* argv, pid_t parent, int out, int err) {
  die_with_parent(parent, SIGTERM);
  signal(SIGINT, SIG_DFL);
  signal(SIGQUIT, SIG_DFL);
  if (out >= 0) dup2(out, STDOUT_FILENO);
  if (err >= 0) dup2(err, STDERR_FILENO);
  execvp(argv[0], argv);
  _exit(127);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int run(std::vector<std::string> words, int out, int err) {
  const std::vector<char*> argv = pointers(words);
  const auto interrupt = signal(SIGINT, SIG_IGN);
  const auto quit = signal(SIGQUIT, SIG_IGN);
  const pid_t parent = getpid(), child = fork();
  if (child == 0) begin_child(argv.data(), parent, out, err);
  const int reason = errno, code = child > 0 ? wait_for(child) : 0;
  signal(SIGINT, interrupt);
  signal(SIGQUIT, quit);
  if (child < 0) throw failed_error(words[0], " could not be started: ", std::strerror(reason));
  if (code == 127)
    throw failed_error("the program ", words[0], " could not be started; is it installed?");
  return code;
}

}  // namespace

void become(const fs::path& program, const std::vector<std::string>& words) {
  std::vector<std::string> all{program.string()};
  all.insert(all.end(), words.begin(), words.end());
  execv(program.c_str(), pointers(all).data());
  throw failed_error(program.string(), " could not be started: ", std::strerror(errno));
}

int run_child(const std::vector<std::string>& words) {
  return run(words, -1, -1);
}

int run_child_to(const std::vector<std::string>& words, int out, int err) {
  return run(words, out, err);
}

int run_child_into(const std::vector<std::string>& words, const fs::path& log) {
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file < 0) throw failed_error(log.string(), ": ", std::strerror(errno));
  const int code = run(words, file, file);
  close(file);
  return code;
}

Captured capture_child(const std::vector<std::string>& words) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out", err = folder / "err";
  const auto file = [](const fs::path& name) {
    return open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  };
  const int to_out = file(out), to_err = file(err);
  Captured captured;
  captured.exit_code = run(words, to_out, to_err);
  close(to_out);
  close(to_err);
  captured.out = read_text(out);
  captured.err = read_text(err);
  return captured;
}

}  // namespace breast
