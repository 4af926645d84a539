// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method for the inverse problem on several ranks: the counterpart of
// mechanics/inverse_system.hpp for a body in parts.
#pragma once

#include "core/report.hpp"
#include "distributed/part_saddle.hpp"
#include "solve/newton.hpp"

namespace breast {

class PartInverse final : public NewtonSystem {
 public:
  /// All references must outlive this object; state.reference and state.p are changed.
  PartInverse(const PartProblem& problem, PartSaddle& solver, SaddleMatrix& matrix, State& state,
              Timer& timer);

  Balance assess(const NewtonResult& so_far) override;
  NewtonDirection direction(const Balance& now) override;
  LineSearchRule rule(const NewtonResult&, const Balance& now,
                      const NewtonDirection&) const override;
  std::optional<Trial> attempt(double length) override;
  void accept(Trial trial) override { state_ = std::move(trial.state); }
  NewtonStop refusal() const override { return refusal_; }
  int folded_element() const override { return problem_.folded_element(state_); }
  const Forces& forces() const { return forces_; }

 private:
  // Distance of a state from equilibrium.
  struct Distance {
    double force = 0, volume = 0;  // relative to the load; largest |θ_e|/V_e
    double merit = 0;
  };
  Distance distance(const Forces& forces) const;
  bool precondition();
  bool solve_direction(double accuracy);

  const PartProblem& problem_;
  PartSaddle& solver_;
  SaddleMatrix& matrix_;
  State& state_;
  Timer& timer_;
  ReferenceTangent tangent_;
  Forces forces_;
  SaddleStep step_;  // of −X and p
  int last_gmres_;
  NewtonStop refusal_ = NewtonStop::folded;
};

}  // namespace breast
