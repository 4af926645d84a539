// SPDX-License-Identifier: GPL-3.0-or-later
// The processes (ranks) that solve one problem together: their start, sums, messages and failures.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/temporary_folder.hpp"

namespace breast {

/// Keeps MPI and PETSc initialised from construction to destruction; constructed once in a process,
/// before any Ranks.
class RankSession {
 public:
  /// Throws Error (failed) if MPI or PETSc cannot be initialised, or if the limit on open files is
  /// too small for them.
  RankSession();
  ~RankSession();
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;

 private:
  std::optional<TemporaryFolder> folder_;  ///< of Open MPI, in a process without mpirun
};

/// An error that all ranks throw together.
class SharedError : public Error {
 public:
  using Error::Error;
};

/// Tags by which MPI tells the messages of Ranks from those of an Exchange.
inline constexpr int bytes_tag = 1, exchange_tag = 2;

/// All ranks of the run. Every member except rank, size, root, send and receive is collective; its
/// result is identical on all ranks, to the last bit.
class Ranks {
 public:
  Ranks();
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Whether this is the rank that reads, writes and prints.
  bool root() const { return rank_ == 0; }

  double sum(double mine) const;
  long sum(long mine) const;
  double most(double mine) const;
  long least(long mine) const;
  bool all(bool mine) const { return least(long(mine)) != 0; }
  /// Sum of `mine` over the ranks below this one.
  long before(long mine) const;
  /// Replaces `bytes` on all ranks by the root's.
  void broadcast(std::vector<char>& bytes) const;
  /// Sends any number of bytes from one rank to another; `receive` waits for them.
  void send(const std::vector<char>& bytes, int to) const;
  std::vector<char> receive(int from) const;

  /// Runs `work` on every rank. If it throws on some ranks, all ranks throw the error of the lowest
  /// of them as a SharedError. `work` may be collective only if it fails either on all ranks or on
  /// none.
  void together(const std::function<void()>& work) const;
  /// Ends all ranks at once, after an error of this rank of which the others do not know.
  [[noreturn]] void abort(int exit_code) const;

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace breast
