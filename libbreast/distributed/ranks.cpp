// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/ranks.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>

#include "distributed/petsc.hpp"

namespace breast {

namespace {

constexpr long most_bytes = 1L << 30;  // of one message: MPI counts in int

// The sum is reduced on the root and sent to all: a sum computed by every rank for itself could
// differ in its last bit.
template <class T>
T reduce(T mine, MPI_Datatype type, MPI_Op how) {
  T all = mine;
  MPI_Reduce(&mine, &all, 1, type, how, 0, MPI_COMM_WORLD);
  MPI_Bcast(&all, 1, type, 0, MPI_COMM_WORLD);
  return all;
}

template <class Pass>
void in_pieces(char* data, std::size_t size, const Pass& pass) {
  for (std::size_t at = 0; at < size; at += most_bytes) {
    pass(data + at, int(std::min<std::size_t>(most_bytes, size - at)));
  }
}

// Open MPI prints 20 to 50 lines and leaves its folder behind if it runs out of file descriptors while it starts.
void check_descriptors() {
  constexpr rlim_t least = 64;  // measured: 16 for one process, 20 for each of three
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= least) return;
  throw failed_error("the limit on open files is ", limit.rlim_cur,
                     " (ulimit -n): MPI needs at least ", least);
}

// Whether neither mpirun nor srun started this process.
bool alone() {
  const auto names = {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};
  return std::none_of(names.begin(), names.end(),
                      [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

RankSession::RankSession() {
  check_descriptors();
  if (alone()) {
    // Open MPI would start a daemon, which outlives this process and removes its folder later, or never.
    folder_.emplace();
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_orte_tmpdir_base", folder_->path().c_str(), 0);
  }
  int given = 0;
  // PETSc's handlers would replace those that say why a program ends.
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS ||
      PetscOptionsSetValue(nullptr, "-no_signal_handler", "true") != 0 ||
      PetscInitializeNoArguments() != 0) {
    throw failed_error("MPI or PETSc cannot begin; run the tool under mpirun");
  }
  // Messages of PETSc are converted to an Error.
  PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr);
}

RankSession::~RankSession() {
  PetscFinalize();
  MPI_Finalize();
}

Ranks::Ranks() {
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

double Ranks::sum(double mine) const {
  return reduce(mine, MPI_DOUBLE, MPI_SUM);
}
long Ranks::sum(long mine) const {
  return reduce(mine, MPI_LONG, MPI_SUM);
}
// MPI does not specify the maximum of two values of which one is not a number.
double Ranks::most(double mine) const {
  const bool good = all(!std::isnan(mine));
  return good ? reduce(mine, MPI_DOUBLE, MPI_MAX) : std::numeric_limits<double>::quiet_NaN();
}
long Ranks::least(long mine) const {
  return reduce(mine, MPI_LONG, MPI_MIN);
}

long Ranks::before(long mine) const {
  long sum = 0;
  MPI_Exscan(&mine, &sum, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
  return root() ? 0 : sum;
}

void Ranks::broadcast(std::vector<char>& bytes) const {
  unsigned long size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  bytes.resize(size);
  in_pieces(bytes.data(), size,
            [](char* at, int count) { MPI_Bcast(at, count, MPI_BYTE, 0, MPI_COMM_WORLD); });
}

void Ranks::send(const std::vector<char>& bytes, int to) const {
  const unsigned long size = bytes.size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG, to, bytes_tag, MPI_COMM_WORLD);
  in_pieces(const_cast<char*>(bytes.data()), size, [&](const char* at, int count) {
    MPI_Send(at, count, MPI_BYTE, to, bytes_tag, MPI_COMM_WORLD);
  });
}

std::vector<char> Ranks::receive(int from) const {
  unsigned long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG, from, bytes_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  std::vector<char> bytes(size);
  in_pieces(bytes.data(), size, [&](char* at, int count) {
    MPI_Recv(at, count, MPI_BYTE, from, bytes_tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  });
  return bytes;
}

void Ranks::together(const std::function<void()>& work) const {
  int kind = -1;
  std::string text;
  try {
    work();
  } catch (const Error& error) {
    kind = int(error.kind());
    text = error.what();
  } catch (const std::bad_alloc&) {
    kind = int(ErrorKind::failed);
    text = "out of memory";
  } catch (const std::exception& error) {
    kind = int(ErrorKind::failed);
    text = error.what();
  }
  const int speaker = int(least(long(kind < 0 ? size_ : rank_)));
  if (speaker == size_) return;
  int length = int(text.size());
  MPI_Bcast(&kind, 1, MPI_INT, speaker, MPI_COMM_WORLD);
  MPI_Bcast(&length, 1, MPI_INT, speaker, MPI_COMM_WORLD);
  text.resize(std::size_t(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, speaker, MPI_COMM_WORLD);
  throw SharedError(ErrorKind(kind), text);
}

void Ranks::abort(int exit_code) const {
  MPI_Abort(MPI_COMM_WORLD, exit_code);
  std::_Exit(exit_code);
}

}  // namespace breast
