// SPDX-License-Identifier: GPL-3.0-or-later
// The load steps of a solve on all ranks: forward.cpp and backward.cpp say which system a step
// solves and what the end of the path means.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "distributed/part_problem.hpp"
#include "distributed/part_saddle.hpp"
#include "mechanics/equilibrium.hpp"
#include "solve/newton.hpp"

namespace breast {

/// Increases the load to its full value, in parts where one step fails. Every function is collective.
class LoadSteps {
 public:
  virtual ~LoadSteps() = default;

  /// Increases the load from `state`, which is the solution of the last load reached at the end.
  void follow(PartProblem& load, State& state);
  Equilibrium found;

 protected:
  /// `tool` names the solve in the progress; `tolerance` is that of the relative residual.
  LoadSteps(const PartProblem& problem, std::string tool, double tolerance, Progress& progress);

  /// Solves one step of the load between the fractions `from` and `to`, starting at `state`; on
  /// success `state` is the solution.
  virtual NewtonResult attempt(State& state, double from, double to) = 0;
  /// Sets status and reason: the path ended at the fraction `reached` of the load, and if that is
  /// below 1, with `failure`.
  virtual void judge(const State& state, double reached, const NewtonResult& failure) = 0;

  /// Runs Newton's method on the system of one step and records its iterations.
  NewtonResult iterate(NewtonSystem& system, double from, double to);
  /// Whether the tangent at `state` is positive definite on the constraints.
  bool definite(const State& state, double augmentation);
  /// Sets the status that belongs to found.stable; `unstable` explains an unstable equilibrium.
  void conclude_stability(const std::string& unstable);

  const PartProblem& problem_;
  PartSaddle solver_;
  SaddleMatrix matrix_;

 private:
  std::string tool_;
  double tolerance_;
  Progress& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Makes the steps of one kind of solve on a part of the body.
using MakeLoadSteps = std::function<std::unique_ptr<LoadSteps>(const PartProblem&)>;

/// Shares `mesh` among the ranks, follows the load of `gravity` (mm/s²) with the steps that `make`
/// makes, from the shape `start` (&HexMesh::imaged or &HexMesh::reference), and collects the result
/// on the root. `gravity_found` (mm/s²) acts on the shape found. Collective.
Equilibrium solve_on_ranks(const Ranks& ranks, const HexMesh& mesh, const MechanicsOptions& options,
                           std::vector<Vec3> HexMesh::*start, const Vec3& gravity,
                           const Vec3& gravity_found, const MakeLoadSteps& make);

}  // namespace breast
