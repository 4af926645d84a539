// SPDX-License-Identifier: GPL-3.0-or-later
// The backward problem of a loaded body: load steps, the inverse solver and the judgement of what they
// found, for a body in one piece and for one that several processes share.
#pragma once

#include <string>

#include "mechanics/inverse_system.hpp"
#include "mechanics/load_steps.hpp"
#include "mechanics/scene.hpp"

namespace breast {

class BackwardSteps {
 public:
  /// As ForwardSteps; `solve_reference` as for the InverseSolver.
  BackwardSteps(LoadedProblem& loaded, SaddleSolverBase& solver, SolveReference solve_reference,
                bool fail_fast, std::string name, Equilibrium& found, Progress& progress);

  /// Increases the load from `state` to `load` (nodal forces, µN) and judges the last solution, which
  /// `state` then is.
  void run(const Eigen::VectorXd& load, State& state);
  /// As run, without a judgement and roughly: the result is only a state from which another solve starts.
  /// `state` changes only if the whole load is reached.
  void approach(const Eigen::VectorXd& load, State& state);
  /// Whether a body that is stable in the imaged shape is found in one step under `load`.
  bool stands(const Eigen::VectorXd& load, State state);
  InverseSolver& inverse() { return inverse_; }

 private:
  LoadReached follow(const Eigen::VectorXd& load, State& state, double tolerance);
  NewtonResult attempt(State& state, double from, double to, double tolerance);
  bool stays(const State& state);
  void judge(const LoadReached& reached);

  LoadedProblem& loaded_;
  SaddleSolverBase& solver_;
  bool fail_fast_;
  std::string name_;
  Equilibrium& found_;
  SolveLog log_;
  InverseSolver inverse_;
};

}  // namespace breast
