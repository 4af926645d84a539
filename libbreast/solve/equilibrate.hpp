// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method for the equilibria of a problem with given X: globalised, with prescribed
// displacements. Near the end one factor may serve several steps, since a slightly outdated tangent
// slows the convergence less than a factorisation would cost.
#pragma once

#include <functional>

#include "core/report.hpp"
#include "solve/newton.hpp"
#include "solve/problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// The smallest det F of a trial is at least this fraction of that at the start of the step.
inline constexpr double determinant_guard = 0.05;

struct NewtonOptions {
  int max_iterations = 30;
  double tolerance = 1e-10;         ///< ‖r on free components‖ / load norm
  double volume_tolerance = 1e-11;  ///< |θ_e| / V_e
  /// Uses one factor for several steps near the end. The solve then stops just below the tolerance,
  /// whereas Newton's last step would go far below it; therefore not suitable for the start of a
  /// path that magnifies small differences.
  bool reuse_factor = false;
  /// Gives up at the first tangent that is not positive definite and at the first linear system
  /// that 60 iterations do not solve, for use with a fallback.
  bool fail_fast = false;
  Timer* timer = nullptr;  ///< seconds by phase, when wanted
};

/// A Newton step with X given: tangent, factorisation, direction, trial states. Derived classes
/// define the convergence criterion.
class TangentSystem : public NewtonSystem {
 public:
  /// All references must outlive this object. `state` is changed.
  TangentSystem(const Problem& problem, SaddleSolverBase& solver, SaddleMatrix& matrix,
                State& state);

  std::optional<Trial> attempt(double length) override;
  void accept(Trial trial) override;
  /// Reason why the last attempt or evaluation was inadmissible.
  NewtonStop refusal() const override { return refusal_; }
  int folded_element() const override { return problem_.folded_element(state_); }
  const Forces& forces() const { return forces_; }
  /// Positions of the first inadmissible trial since the last accepted one.
  const Eigen::VectorXd& refused() const { return refused_; }

 protected:
  /// Compares a trial with the start of the step.
  virtual Appraisal appraise(const State& state, const Forces& forces) const = 0;
  /// Moves sliding nodes to their surface; returns false if a node lies beyond it.
  bool put_on_surface();
  /// Moves sliding nodes to their surface and evaluates the forces; returns false if this is
  /// inadmissible, for the reason given by `refusal`.
  bool look();
  /// Assembles the tangent at the present state, with its forces; false: inadmissible.
  bool assemble();
  /// Factorises under `constraints`, with a shift if necessary and allowed.
  Factorisation factorise(const Constraints& constraints, bool may_shift = true);
  /// Solves for the direction with the present forces and the last factor.
  NewtonDirection solve(double volume_accuracy, int restarts);
  /// Makes a change that alters only the forces of these terms, and updates the forces.
  void change(const std::vector<const Term*>& terms, const std::function<void()>& what);
  double along(const Eigen::VectorXd& gradient) const { return problem_.dot(step_.u, gradient); }

  const Problem& problem_;
  SaddleSolverBase& solver_;
  SaddleMatrix& matrix_;
  State& state_;
  Forces forces_;
  SaddleStep step_;

 private:
  bool follow_surface(double length, State& trial) const;

  double shift_ = 0;
  NewtonStop refusal_ = NewtonStop::folded;
  Eigen::VectorXd refused_;
};

struct EquilibriumResult : NewtonResult {
  Forces forces;  ///< at the final state (valid when the last state was admissible)
};

/// Moves `state` to equilibrium. `targets`: positions of held components (3 per node; other entries
/// ignored); null: held components remain. If not converged, `state` is the last admissible one. A
/// state with an element that is not positive at a corner is not accepted, however small its
/// residual.
EquilibriumResult equilibrate(const Problem& problem, SaddleSolverBase& solver,
                              SaddleMatrix& matrix, State& state, const NewtonOptions& options = {},
                              const Eigen::VectorXd* targets = nullptr,
                              const std::function<void(const NewtonIteration&)>& watch = {});

}  // namespace breast
