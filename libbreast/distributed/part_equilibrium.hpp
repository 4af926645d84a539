// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method for equilibria on several ranks: the counterpart of solve/equilibrate.hpp for a
// body in parts.
#pragma once

#include <functional>

#include "core/report.hpp"
#include "distributed/part_saddle.hpp"
#include "solve/newton.hpp"

namespace breast {

/// ‖r on free components‖ / load norm of a solution.
inline constexpr double part_equilibrium_tolerance = 1e-10;

class PartEquilibrium final : public NewtonSystem {
 public:
  /// All references must outlive this object; `state` is changed.
  PartEquilibrium(const PartProblem& problem, PartSaddle& solver, SaddleMatrix& matrix,
                  State& state, int max_iterations, Timer& timer);

  Balance assess(const NewtonResult& so_far) override;
  NewtonDirection direction(const Balance& now) override;
  LineSearchRule rule(const NewtonResult& so_far, const Balance& now,
                      const NewtonDirection& direction) const override;
  std::optional<Trial> attempt(double length) override;
  void accept(Trial trial) override;
  NewtonStop refusal() const override { return refusal_; }
  int folded_element() const override { return problem_.folded_element(state_); }
  const Forces& forces() const { return forces_; }

 private:
  bool reached(double residual) const;
  double residual(const Constraints& held, const Forces& forces) const {
    return problem_.free_norm(held, forces) / problem_.load_norm();
  }
  bool follow_surface(double length, State& trial) const;

  const PartProblem& problem_;
  PartSaddle& solver_;
  SaddleMatrix& matrix_;
  State& state_;
  int max_iterations_;
  Timer& timer_;
  Forces forces_;
  SaddleStep step_;
  bool serves_ = false;  // whether the last multigrid levels are used for this step too
  NewtonStop refusal_ = NewtonStop::folded;
};

}  // namespace breast
