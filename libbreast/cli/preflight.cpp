// SPDX-License-Identifier: GPL-3.0-or-later
// Checks for limits of the process (ulimit) that are too small for the libraries to start, and for closed
// standard streams; the message is one line printed before the libraries are loaded. OpenBLAS, which allocates memory for every
// thread when it is loaded, retries for ever if there is none.
#include "cli/preflight.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

extern "C" {
void openblas_set_num_threads(int) __attribute__((weak));  // there when the program needs OpenBLAS
}

namespace breast {

namespace {

constexpr rlim_t mb = rlim_t(1) << 20;
constexpr rlim_t least_stack_mb = 1;    // with 512 kB the mechanics overflow
constexpr rlim_t blas_thread_mb = 160;  // buffer, stack and arena; measured: 140
constexpr rlim_t work_mb = 128;

int blas_threads() {
  for (const char* name : {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"}) {
    const char* text = std::getenv(name);
    const int count = text == nullptr ? 0 : std::atoi(text);
    if (count > 0) return count;
  }
  cpu_set_t cores;
  return sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

rlim_t mapped_mb() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  unsigned long pages = 0;
  if (file == nullptr) return 0;
  if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
  std::fclose(file);
  return rlim_t(pages) * rlim_t(sysconf(_SC_PAGESIZE)) / mb;
}

// A standard stream that was closed (>&-) would be the number of the next file that is opened, and what is
// printed would go there. In its place, /dev/null the wrong way round refuses what is printed or read.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    const int opened = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (opened >= 0 && opened != stream) close(opened);
  }
}

// The dynamic loader calls this before the initialisation of any library.
void check_limits(int, char** argv, char**) {
  occupy_closed_streams();
  rlimit limit{};
  const char* name = argv[0];
  for (const char* c = argv[0]; *c != 0; ++c) {
    if (*c == '/') name = c + 1;
  }
  if (getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      limit.rlim_cur < least_stack_mb * mb) {
    dprintf(STDERR_FILENO,
            "%s: the limit on the stack is %lu kB (ulimit -s): at least %lu are needed\n", name,
            (unsigned long)(limit.rlim_cur / 1024), (unsigned long)(least_stack_mb * 1024));
    _exit(1);
  }
  if (openblas_set_num_threads == nullptr || getrlimit(RLIMIT_AS, &limit) != 0 ||
      limit.rlim_cur == RLIM_INFINITY) {
    return;
  }
  const int threads = blas_threads();
  const rlim_t needed = mapped_mb() + work_mb + rlim_t(threads) * blas_thread_mb;
  if (limit.rlim_cur / mb >= needed) return;
  dprintf(STDERR_FILENO,
          "%s: the limit on memory is %lu MB (ulimit -v): at least %lu are needed with %d "
          "threads of OpenBLAS; OPENBLAS_NUM_THREADS=1 needs the least\n",
          name, (unsigned long)(limit.rlim_cur / mb), (unsigned long)needed, threads);
  _exit(1);
}

#if !defined(__SANITIZE_ADDRESS__)  // which maps terabytes, and starts here itself
__attribute__((section(".preinit_array"),
               used)) void (*const before_libraries)(int, char**, char**) = check_limits;
#endif

}  // namespace

bool has_preflight() {
  return true;
}

}  // namespace breast
