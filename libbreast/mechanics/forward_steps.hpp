// SPDX-License-Identifier: GPL-3.0-or-later
// The forward problem of a loaded body: load steps, Newton's method and the judgement of what they
// found, for a body in one piece and for one that several processes share.
#pragma once

#include <functional>
#include <string>

#include "mechanics/load_steps.hpp"
#include "mechanics/scene.hpp"
#include "solve/saddle.hpp"

namespace breast {

class ForwardSteps {
 public:
  /// Records in `found`; `name` is shown in the progress. With `fail_fast` it gives up at the first
  /// difficulty. All references must outlive this.
  ForwardSteps(LoadedProblem& loaded, SaddleSolverBase& solver, SaddleMatrix& matrix,
               bool fail_fast, std::string name, Equilibrium& found, Progress& progress);

  /// Increases the load from `state` to `load` (nodal forces, µN) and judges the last equilibrium,
  /// which `state` then is. `guess`: as of LoadSteps.
  NewtonResult run(const Eigen::VectorXd& load, State& state, std::optional<State> guess = {});
  /// The same for a load (nodal forces, µN) that is `load_at` of a part of the way, 0 to 1; `state` is
  /// the solution for load_at(0).
  NewtonResult run(const std::function<Eigen::VectorXd(double)>& load_at, State& state,
                   std::optional<State> guess = {});
  /// Whether a stable equilibrium is found in one step under the present load.
  bool stands(State& state) { return attempt(state, 0, 1).converged && stays(state); }

 private:
  NewtonResult attempt(State& state, double from, double to);
  bool stays(const State& state);

  LoadedProblem& loaded_;
  SaddleSolverBase& solver_;
  SaddleMatrix& matrix_;
  bool fail_fast_;
  std::string name_;
  Equilibrium& found_;
  SolveLog log_;
};

}  // namespace breast
