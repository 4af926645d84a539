// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/guarded_child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>

#include "core/error.hpp"

namespace breast {

namespace {

// First byte of what the child sends.
enum Answer : char { result = 'r', refusal = 'i', failure = 'f', no_memory = 'm' };

void send(int descriptor, char answer, std::string_view bytes) {
  const auto all = [&](const char* data, std::size_t size) {
    while (size > 0) {
      const ssize_t now = write(descriptor, data, size);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) _exit(1);
      data += now;
      size -= std::size_t(now);
    }
  };
  all(&answer, 1);
  all(bytes.data(), bytes.size());
}

// Address space beyond what the parent has; a sanitizer reserves far more by itself.
void limit_memory([[maybe_unused]] double memory_mb) {
#if !defined(__SANITIZE_ADDRESS__)
  const rlim_t more = rlim_t(memory_mb) << 20;
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  rlimit space{};
  if (!(statm >> pages) || getrlimit(RLIMIT_AS, &space) != 0) return;
  const rlim_t wanted = pages * rlim_t(sysconf(_SC_PAGESIZE)) + more;
  if (space.rlim_cur != RLIM_INFINITY && space.rlim_cur < wanted) return;
  space.rlim_cur = wanted;
  setrlimit(RLIMIT_AS, &space);
#endif
}

void limit(double cpu_seconds, double memory_mb) {
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  const auto cpu = rlim_t(cpu_seconds) + 1;
  const rlimit time{cpu, cpu + 1};  // SIGXCPU, then SIGKILL
  setrlimit(RLIMIT_CPU, &time);
  limit_memory(memory_mb);
  for (const int fault : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) signal(fault, SIG_DFL);
  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (null >= 0) dup2(null, STDERR_FILENO), dup2(null, STDOUT_FILENO);
}

[[noreturn]] void child(int descriptor, const std::function<std::string()>& work,
                        double cpu_seconds, double memory_mb) {
  limit(cpu_seconds, memory_mb);
  try {
    send(descriptor, result, work());
  } catch (const Error& error) {
    send(descriptor, error.kind() == ErrorKind::input ? refusal : failure, error.what());
  } catch (const std::bad_alloc&) {
    send(descriptor, no_memory, "");
  } catch (const std::exception& error) {
    send(descriptor, refusal, error.what());
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

// What the child sends until it closes its end; false when that takes longer than `seconds`.
bool receive(int descriptor, double seconds, std::string& answer) {
  const auto start = std::chrono::steady_clock::now();
  constexpr std::size_t piece = std::size_t(1) << 20;
  while (true) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    if (passed.count() > seconds) return false;
    pollfd ready{descriptor, POLLIN, 0};
    constexpr int wait_ms = 200;
    const int events = poll(&ready, 1, wait_ms);
    if (events == 0 || (events < 0 && errno == EINTR)) continue;
    const std::size_t have = answer.size();
    if (answer.capacity() < have + piece) answer.reserve(2 * have + piece);
    answer.resize(have + piece);
    const ssize_t now = read(descriptor, answer.data() + have, piece);
    answer.resize(have + std::size_t(now > 0 ? now : 0));
    if (now == 0 || (now < 0 && errno != EINTR)) return true;
  }
}

}  // namespace

void die_with_parent(pid_t parent, int signal) {
  constexpr int nobody_reads_it = 127;
  prctl(PR_SET_PDEATHSIG, signal);
  if (getppid() != parent) _exit(nobody_reads_it);
}

std::string in_guarded_child(const std::string& name, const std::function<std::string()>& work,
                             double seconds, double memory_mb, double cpu_seconds) {
  cpu_seconds = std::min(cpu_seconds, seconds);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw failed_error(name, ": no pipe to a reading process (", std::strerror(errno), ")");
  }
  const pid_t parent = getpid(), process = fork();
  if (process < 0) {
    const int reason = errno;
    close(ends[0]);
    close(ends[1]);
    throw failed_error(name, ": no process to read it (", std::strerror(reason), ")");
  }
  if (process == 0) {
    die_with_parent(parent, SIGKILL);
    close(
        ends[0]);  // otherwise a write would wait for ever once the parent, its only reader, is gone
    child(ends[1], work, cpu_seconds, memory_mb);
  }
  close(ends[1]);
  std::string answer;
  const auto end = [&](bool late) {
    close(ends[0]);
    if (late) kill(process, SIGKILL);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
  };
  bool in_time = false;
  try {
    in_time = receive(ends[0], seconds, answer);
  } catch (const std::bad_alloc&) {
    end(true);
    throw input_error(name, ": its content does not fit in memory");
  }
  const int status = end(!in_time);
  if (!in_time) throw input_error(name, ": reading it takes more than ", seconds, " s: damaged");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    throw input_error(name, ": reading it takes more than ", cpu_seconds,
                      " s of processor time: damaged");
  if (answer.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string how =
        WIFSIGNALED(status) ? message(" (signal ", WTERMSIG(status), ")") : std::string();
    throw input_error(name, ": damaged: the library that reads it crashed", how);
  }
  const char kind = answer.front();
  answer.erase(0, 1);
  if (kind == result) return answer;
  if (kind == no_memory) throw input_error(name, ": declares more data than fit in memory");
  throw Error(kind == refusal ? ErrorKind::input : ErrorKind::failed, answer);
}

}  // namespace breast
