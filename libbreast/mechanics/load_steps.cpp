// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/load_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double smallest_step = 1.0 / 40, growth = 1.5;

/// Completed fraction of a Newton solve, for progress bars only: that of the decades from the first
/// residual to the tolerance. It never decreases.
class SolvePace {
 public:
  explicit SolvePace(double tolerance) : tolerance_(tolerance) {}
  double after(const NewtonIteration& iteration) {
    first_ = std::max(first_, iteration.residual_before);
    const double decades = std::log(first_ / tolerance_);
    if (decades > 0 && iteration.residual > 0)
      done_ = std::clamp(std::log(first_ / iteration.residual) / decades, done_, 1.0);
    return done_;
  }

 private:
  double tolerance_, first_ = 0, done_ = 0;
};

}  // namespace

LoadReached follow_load(const LoadSteps& steps, State& state) {
  LoadReached reached;
  double step = 1;
  while (!reached.whole()) {
    const double next = std::min(1.0, reached.part + step);
    steps.set_load(next);
    const bool first = reached.part == 0 && step == 1;
    State trial = first && steps.guess ? *steps.guess : state;
    reached.last = steps.solve(trial, reached.part, next);
    if (reached.last.converged) {
      state = std::move(trial);
      reached.part = next;
      step *= growth;
    } else {
      step *= 0.5;
      if (!steps.divide || step < smallest_step) break;
    }
  }
  return reached;
}

SolveLog::Watch SolveLog::begin_step(const std::string& name, double from, double to,
                                     double tolerance) {
  const int step = ++summary_.steps;
  return [=, this, pace = SolvePace(tolerance)](const NewtonIteration& iteration) mutable {
    record(step, iteration);
    show(name, from + (to - from) * pace.after(iteration), iteration);
  };
}

SolveLog::Watch SolveLog::begin_step(const std::string& name) {
  const int step = ++summary_.steps;
  return [=, this](const NewtonIteration& iteration) {
    record(step, iteration);
    show(name, -1, iteration);
  };
}

void SolveLog::record(int step, const NewtonIteration& iteration) {
  const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
  IterationRecord record;
  record.step = step;
  record.iteration = ++summary_.newton_iterations;
  record.residual = iteration.residual;
  record.min_det_F = iteration.min_det_F;
  record.max_det_F = iteration.max_det_F;
  record.step_length = iteration.step_length;
  record.seconds = clock.count();
  summary_.linear_iterations += iteration.linear_iterations;
  summary_.record.iterations.push_back(record);
}

void SolveLog::show(const std::string& name, double done, const NewtonIteration& iteration) {
  progress_.update(
      name, done,
      message("iteration ", summary_.newton_iterations, ", residual ", iteration.residual));
}

}  // namespace breast
