// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a tool, with nested keys and values, which --report writes as JSON.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Keys are paths ("landmarks/tumour/displacement_mm"). A non-finite number becomes null.
class Report {
 public:
  Report();
  ~Report();
  Report(const Report&);
  Report(Report&&) noexcept;
  Report& operator=(Report) noexcept;

  void set(std::string_view path, double value);
  void set(std::string_view path, long long value);
  void set(std::string_view path, int value) { set(path, static_cast<long long>(value)); }
  void set(std::string_view path, std::size_t value) { set(path, static_cast<long long>(value)); }
  void set(std::string_view path, bool value);
  void set(std::string_view path, std::string_view value);
  void set(std::string_view path, const char* value) { set(path, std::string_view(value)); }
  void set(std::string_view path, const std::vector<double>& value);
  void set(std::string_view path, const std::vector<std::string>& value);
  void set(std::string_view path, const Vec3& value);
  /// Appends a string to a list: warnings, things to doubt.
  void append(std::string_view path, std::string_view value);
  /// Copies the entry of another report at `path`, a value or everything below it. Throws Error
  /// (failed) if it does not exist.
  void copy(std::string_view path, const Report& from);

  bool contains(std::string_view path) const;
  /// The number at `path`. Throws Error (failed) if it is absent or not a number.
  double number(std::string_view path) const;
  std::string text(std::string_view path) const;

  std::string json() const;
  static Report parse(const std::string& json, std::string_view name);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Wall seconds per named phase. `Timer::Scope phase(timer, "assembly");`
class Timer {
 public:
  class Scope {
   public:
    Scope(Timer& timer, std::string phase)
        : timer_(timer), phase_(std::move(phase)), start_(std::chrono::steady_clock::now()) {}
    ~Scope() {
      timer_.seconds_[phase_] +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timer& timer_;
    std::string phase_;
    std::chrono::steady_clock::time_point start_;
  };
  const std::map<std::string, double>& seconds() const { return seconds_; }
  double seconds(const std::string& phase) const {
    const auto found = seconds_.find(phase);
    return found == seconds_.end() ? 0.0 : found->second;
  }
  void add(const std::string& phase, double seconds) { seconds_[phase] += seconds; }
  /// Moves `seconds` from phase `from` to phase `to`.
  void move(const std::string& from, const std::string& to, double seconds) {
    seconds_[from] -= seconds;
    seconds_[to] += seconds;
  }
  /// Sets "seconds/PHASE" for every phase.
  void write(Report& report) const;

 private:
  std::map<std::string, double> seconds_;
};

/// CPU time of this process so far, user and system, all threads, in seconds.
double cpu_seconds();
/// Peak resident memory of this process in MB.
double peak_memory_mb();

}  // namespace breast
