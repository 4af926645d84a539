// SPDX-License-Identifier: GPL-3.0-or-later
// Load steps: a load is applied at once, and in parts where that does not converge. Also the record of
// the Newton iterations on the way.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "core/progress.hpp"
#include "mechanics/equilibrium.hpp"
#include "solve/newton.hpp"

namespace breast {

/// What a load step is for a problem.
struct LoadSteps {
  /// Sets the load to a part of the whole, 0 to 1.
  std::function<void(double part)> set_load;
  /// Solves for the load `to`, starting at the solution for `from`; on success `state` is the new
  /// solution.
  std::function<NewtonResult(State& state, double from, double to)> solve;
  /// A state near the solution for the whole load, if one is known. Only the first attempt starts there.
  std::optional<State> guess;
  /// Whether a step that fails is divided.
  bool divide = true;
};

struct LoadReached {
  double part = 0;    ///< of the load, for which `state` is the solution
  NewtonResult last;  ///< of the last step; a failure if part < 1
  bool whole() const { return part >= 1; }
};

/// Increases the load from nothing, for which `state` is the solution, to the whole. After a failure a
/// step is halved, after a success it grows; gives up at a fortieth of the load.
LoadReached follow_load(const LoadSteps& steps, State& state);

/// Records the steps and Newton iterations of a solve in its summary and shows its progress.
class SolveLog {
 public:
  using Watch = std::function<void(const NewtonIteration&)>;

  /// Both must outlive this object.
  SolveLog(SolveSummary& summary, Progress& progress) : summary_(summary), progress_(progress) {}

  /// Begins a step and returns what its solve calls after each iteration. `name` is shown; the step
  /// is the share from `from` to `to` of the work (0 to 1) and ends at the relative residual
  /// `tolerance`.
  Watch begin_step(const std::string& name, double from, double to, double tolerance);
  /// The same for a step of unknown share.
  Watch begin_step(const std::string& name);
  /// Appends an iteration of this step.
  void record(int step, const NewtonIteration& iteration);

 private:
  void show(const std::string& name, double done, const NewtonIteration& iteration);

  SolveSummary& summary_;
  Progress& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace breast
