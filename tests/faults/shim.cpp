// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded into a tool by tests/tools/faults.cpp: lets one system call that puts something out, or one
// allocation, fail. Environment:
//   BREAST_FAULT       PROGRAM:KIND:N[:ERRNO[+]]  the N-th (from 1) call of that kind in PROGRAM fails with ERRNO;
//                      with "+" every later one, too. KIND is output, allocation, loss (the bytes written to a file are
//                      lost without a word) or damage (one of them arrives as another); N = 0 only counts.
//   BREAST_FAULT_MARK  file: gets one line "failed CALL" a failure, and at the end "counted N"
//   BREAST_FAULT_FORK  FOLDER:K[,N...]: the program branches (branches.hpp) before its K-th output call and before its N-th
//                      allocations, which are in order and before that. There it writes "output COUNT" or "allocation COUNT"
//                      (of allocations so far) into FOLDER/answers and obeys FOLDER/orders, a line each: "try PLAN BYTES"
//                      goes on in a forked process with a plan as in BREAST_FAULT, counted from this call on, and files no
//                      longer than BYTES (-1: any), and answers with its wait status; "go" goes on to the next branch.
// A program that takes longer than ten minutes of processor time hangs and ends by SIGXCPU; after half an hour it waits for
// ever and ends by SIGALRM. Counted from main() on, in the program and the processes it forks together. Standard error works
// always.
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum Kind { nothing, output, allocation, loss, damage };

struct Plan {
  Kind kind = nothing;
  long nth = 0;
  int reason = ENOSPC;
  bool onwards = false;
  char mark[4096] = "";
  pid_t owner = 0;
  std::atomic<long>* counter = nullptr;  ///< shared with forked processes
};
Plan plan;

void mark(const char* text) {
  const int file =
      int(syscall(SYS_openat, AT_FDCWD, plan.mark, O_WRONLY | O_CREAT | O_APPEND, 0600));
  if (file < 0) return;
  syscall(SYS_write, file, text, strlen(text));
  syscall(SYS_close, file);
}

// A program that branches: the long computation before an output call is done only once.
struct Branches {
  int orders = -1, answers = -1;
  long next[4096], count = 0, tried = 0;  ///< allocations to branch at
  long allocations = 0, outputs_left = 0;
  pid_t owner = 0;
  pid_t trial = 0,
        program = 0;  ///< a forked process that tries a failure takes itself for the program
};
Branches branches;

pid_t own_id() {
  return pid_t(syscall(SYS_getpid));
}

void set_plan(const char* text);

// One line of the orders, without malloc.
bool next_order(char* line, size_t size) {
  size_t n = 0;
  for (char c = 0;
       n + 1 < size && syscall(SYS_read, branches.orders, &c, size_t(1)) == 1 && c != '\n';)
    line[n++] = c;
  line[n] = 0;
  return n > 0;
}

void answer(const char* line) {
  syscall(SYS_write, branches.answers, line, strlen(line));
}

// The tool as it is here with another plan.
bool become_trial(const char* order) {
  char text[256];
  long bytes = -1;
  if (sscanf(order, "try %255s %ld", text, &bytes) != 2) _exit(125);
  const int out = int(syscall(SYS_openat, AT_FDCWD, ".stdout", O_WRONLY | O_CREAT | O_TRUNC, 0600));
  dup2(out, STDOUT_FILENO);
  for (const int file : {out, branches.orders, branches.answers}) syscall(SYS_close, file);
  branches.program = branches.owner;
  branches.owner = 0;
  branches.trial = own_id();
  set_plan(text);
  if (bytes >= 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{rlim_t(bytes), rlim_t(bytes)};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  return true;
}

// True in a forked process that tries a failure.
bool branch(const char* at) {
  char line[512];
  snprintf(line, sizeof line, "%s %ld\n", at, branches.allocations);
  answer(line);
  while (next_order(line, sizeof line)) {
    if (strcmp(line, "go") == 0) return false;
    const pid_t child = fork();
    if (child == 0) return become_trial(line);
    int status = 0;
    waitpid(child, &status, 0);
    snprintf(line, sizeof line, "status %d\n", status);
    answer(line);
  }
  _exit(0);
}

void branch_where_due(Kind kind) {
  if (branches.owner == 0 || branches.owner != own_id()) return;
  if (kind == output) {
    if (--branches.outputs_left <= 0) branch("output");
  } else if (kind == allocation) {
    ++branches.allocations;
    if (branches.tried == branches.count || branches.allocations < branches.next[branches.tried])
      return;
    ++branches.tried;
    branch("allocation");
  }
}

bool fails(Kind kind, const char* call) {
  branch_where_due(kind);
  if (plan.kind != kind || plan.counter == nullptr) return false;
  const long now = ++*plan.counter;
  if (plan.nth == 0 || now < plan.nth || (now > plan.nth && !plan.onwards)) return false;
  if (now == plan.nth) {
    char line[64];
    snprintf(line, sizeof line, "failed %s\n", call);
    mark(line);
  }
  errno = plan.reason;
  return true;
}

// What a disk or a reader can refuse; not the connection to an X server.
bool counts(int descriptor) {
  struct stat status;
  if (descriptor == STDERR_FILENO || syscall(SYS_fstat, descriptor, &status) != 0) return false;
  return S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode);
}
bool is_file(int descriptor) {
  struct stat status;
  return descriptor > STDERR_FILENO && syscall(SYS_fstat, descriptor, &status) == 0 &&
         S_ISREG(status.st_mode);
}
bool puts_out(int flags) {
  return (flags & O_CREAT) != 0;
}

template <class F>
F next(const char* name, F) {
  return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}
#define NEXT(f) static const auto real = next(#f, &f)

void set_plan(const char* text) {
  char program[256], kind[16];
  int reason = ENOSPC;
  char plus = 0;
  if (sscanf(text, "%255[^:]:%15[^:]:%ld:%d%c", program, kind, &plan.nth, &reason, &plus) < 3)
    return;
  if (strcmp(program, program_invocation_short_name) != 0) return;
  const auto named = [&](const char* name) { return strcmp(kind, name) == 0; };
  const Kind wanted = named("allocation") ? allocation
                      : named("loss")     ? loss
                      : named("damage")   ? damage
                                          : output;
  plan.reason = wanted == allocation ? ENOMEM : reason;
  plan.onwards = plus == '+';
  plan.owner = own_id();
  void* shared = mmap(nullptr, sizeof *plan.counter, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return;
  plan.counter = new (shared) std::atomic<long>(0);
  plan.kind = wanted;
  constexpr rlim_t hang_s = 600;
  constexpr unsigned waiting_s = 1800;
  const rlimit hang{hang_s, RLIM_INFINITY};
  setrlimit(RLIMIT_CPU, &hang);
  alarm(waiting_s);
}

void read_branches(const char* text) {
  char folder[3000], name[4096];
  int used = 0;
  if (sscanf(text, "%2999[^:]:%ld%n", folder, &branches.outputs_left, &used) != 2) return;
  for (const char* rest = text + used; *rest != 0 && branches.count < 4096;) {
    char* end = nullptr;
    branches.next[branches.count++] = strtol(rest + 1, &end, 10);
    rest = end;
  }
  snprintf(name, sizeof name, "%s/orders", folder);
  branches.orders = int(syscall(SYS_openat, AT_FDCWD, name, O_RDONLY | O_CLOEXEC));
  snprintf(name, sizeof name, "%s/answers", folder);
  branches.answers = int(syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CLOEXEC));
  branches.owner = own_id();
}

void read_environment() {
  const char* file = getenv("BREAST_FAULT_MARK");
  if (file == nullptr) return;
  snprintf(plan.mark, sizeof plan.mark, "%s", file);
  const char* text = getenv("BREAST_FAULT");
  if (text == nullptr) return;
  const char* folder = getenv("BREAST_FAULT_FORK");
  if (folder == nullptr) return set_plan(text);
  const size_t program = strlen(program_invocation_short_name);
  if (strncmp(text, program_invocation_short_name, program) == 0 && text[program] == ':')
    read_branches(folder);
}

using Main = int (*)(int, char**, char**);
Main real_main;

int armed_main(int argc, char** argv, char** environment) {
  read_environment();
  const int code = real_main(argc, argv, environment);
  if (plan.kind != nothing && own_id() == plan.owner) {
    char line[64];
    const long counted = *plan.counter;
    plan.kind = nothing;
    snprintf(line, sizeof line, "counted %ld\n", counted);
    mark(line);
  }
  return code;
}

}  // namespace

extern "C" {

int __libc_start_main(Main main, int argc, char** argv, Main init, void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  using Start = int (*)(Main, int, char**, Main, void (*)(), void (*)(), void*);
  real_main = main;
  const Start start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(armed_main, argc, argv, init, fini, rtld_fini, stack_end);
}

pid_t getpid() {
  const pid_t id = own_id();
  return id == branches.trial ? branches.program : id;
}
pid_t getppid() {
  const pid_t id = pid_t(syscall(SYS_getppid));
  return id == branches.trial ? branches.program : id;
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (counts(descriptor) && fails(output, "write")) return -1;
  if (plan.kind == loss && is_file(descriptor) && fails(loss, "write")) return ssize_t(size);
  if (plan.kind == damage && size > 0 && is_file(descriptor) && fails(damage, "write")) {
    // Half of them and one more, so that the rest follows in order.
    const size_t half = size / 2;
    const char other = char(static_cast<const char*>(bytes)[half] ^ 1);
    if (half > 0 && syscall(SYS_write, descriptor, bytes, half) != ssize_t(half)) return -1;
    return syscall(SYS_write, descriptor, &other, size_t(1)) == 1 ? ssize_t(half + 1) : -1;
  }
  return syscall(SYS_write, descriptor, bytes, size);
}
ssize_t writev(int descriptor, const iovec* pieces, int count) {
  if (counts(descriptor) && fails(output, "writev")) return -1;
  return syscall(SYS_writev, descriptor, pieces, count);
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t at) {
  if (counts(descriptor) && fails(output, "pwrite")) return -1;
  return syscall(SYS_pwrite64, descriptor, bytes, size, at);
}
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  if (counts(descriptor) && fails(output, "pwrite")) return -1;
  return syscall(SYS_pwrite64, descriptor, bytes, size, at);
}
size_t fwrite(const void* bytes, size_t size, size_t count, FILE* stream) {
  NEXT(fwrite);
  if (stream != stderr && fails(output, "fwrite")) return 0;
  return real(bytes, size, count, stream);
}
int fflush(FILE* stream) {
  NEXT(fflush);
  if (stream == stdout && fails(output, "fflush")) return EOF;
  return real(stream);
}
int fsync(int descriptor) {
  if (fails(output, "fsync")) return -1;
  return int(syscall(SYS_fsync, descriptor));
}
int fdatasync(int descriptor) {
  if (fails(output, "fdatasync")) return -1;
  return int(syscall(SYS_fdatasync, descriptor));
}
int rename(const char* from, const char* to) {
  if (fails(output, "rename")) return -1;
  return int(syscall(SYS_renameat, AT_FDCWD, from, AT_FDCWD, to));
}
int mkdir(const char* name, mode_t mode) {
  if (fails(output, "mkdir")) return -1;
  return int(syscall(SYS_mkdirat, AT_FDCWD, name, mode));
}
char* mkdtemp(char* name) {
  NEXT(mkdtemp);
  return fails(output, "mkdtemp") ? nullptr : real(name);
}
int close(int descriptor) {
  const int flags = plan.kind == output ? int(syscall(SYS_fcntl, descriptor, F_GETFL)) : 0;
  const bool written = flags > 0 && (flags & O_ACCMODE) != O_RDONLY && counts(descriptor);
  const int code = int(syscall(SYS_close, descriptor));
  return written && fails(output, "close") ? -1 : code;
}
int open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = puts_out(flags) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (puts_out(flags) && fails(output, "open")) return -1;
  return int(syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}
int open64(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = puts_out(flags) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  if (puts_out(flags) && fails(output, "open")) return -1;
  return int(syscall(SYS_openat, AT_FDCWD, name, flags, mode));
}
FILE* fopen(const char* name, const char* mode) {
  NEXT(fopen);
  return mode[0] != 'r' && fails(output, "fopen") ? nullptr : real(name, mode);
}
FILE* fopen64(const char* name, const char* mode) {
  NEXT(fopen64);
  return mode[0] != 'r' && fails(output, "fopen") ? nullptr : real(name, mode);
}

void* malloc(size_t size) {
  return fails(allocation, "malloc") ? nullptr : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  return fails(allocation, "calloc") ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  return size > 0 && fails(allocation, "realloc") ? nullptr : __libc_realloc(old, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  return fails(allocation, "aligned_alloc") ? nullptr : __libc_memalign(alignment, size);
}
void* memalign(size_t alignment, size_t size) {
  return fails(allocation, "memalign") ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** place, size_t alignment, size_t size) {
  if (fails(allocation, "posix_memalign")) return ENOMEM;
  void* found = __libc_memalign(alignment, size);
  if (found == nullptr) return ENOMEM;
  *place = found;
  return 0;
}
}
