// SPDX-License-Identifier: GPL-3.0-or-later
// The processes that solve one problem together: how they begin, add up, exchange and fail.
#pragma once

#include <functional>
#include <vector>

#include "core/error.hpp"

namespace breast {

/// MPI and PETSc from construction to destruction; once in a process, before any Ranks.
class RankSession {
 public:
  /// Throws Error (failed) where they cannot begin.
  RankSession();
  ~RankSession();
  RankSession(const RankSession&) = delete;
  RankSession& operator=(const RankSession&) = delete;
};

/// An error that all ranks have thrown together.
class SharedError : public Error {
 public:
  using Error::Error;
};

/// All ranks of the run. Every member but rank, size, root, send and receive is collective; what is
/// returned is the same on all, to the last bit.
class Ranks {
 public:
  Ranks();
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// The rank that reads, writes and speaks.
  bool root() const { return rank_ == 0; }

  double sum(double mine) const;
  long sum(long mine) const;
  double most(double mine) const;
  double least(double mine) const;
  long least(long mine) const;
  bool all(bool mine) const { return least(long(mine)) != 0; }
  /// Sum over the ranks below this one.
  long before(long mine) const;
  /// The root's bytes, on all ranks.
  void broadcast(std::vector<char>& bytes) const;
  /// Bytes of any number from one rank to another; `receive` waits for them.
  void send(const std::vector<char>& bytes, int to) const;
  std::vector<char> receive(int from) const;

  /// Does `work` on every rank. Where it throws on some, all throw the error of the lowest of them
  /// as a SharedError. `work` may be collective only where it fails on all ranks or on none.
  void together(const std::function<void()>& work) const;
  /// Ends all ranks at once: for an error of this one that the others do not know of.
  [[noreturn]] void abort(int exit_code) const;

 private:
  int rank_ = 0, size_ = 1;
};

}  // namespace breast
