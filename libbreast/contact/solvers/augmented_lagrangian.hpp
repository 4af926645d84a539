// SPDX-License-Identifier: GPL-3.0-or-later
// The paper's contact method, an augmented Lagrangian: Uzawa updates of nodal contact forces around
// penalised equilibria. It is kept for comparison with the active set and leaves a small
// penetration.
#pragma once

#include <memory>
#include <vector>

#include "contact/solvers/solver.hpp"
#include "contact/terms/plate.hpp"

namespace breast {

struct AugmentedLagrangianOptions {
  double penalty = 1e5;         ///< µN/mm per node to start with; about 10 μ h
  double gap_tolerance = 2e-4;  ///< mm of penetration, or of gap under a force
  int most_updates = 25, most_iterations = 40;
};

class AugmentedLagrangian : public ContactSolver {
 public:
  /// `body`: everything but the plates. `solver` must outlive this.
  AugmentedLagrangian(const Problem& body, SaddleSolver& solver, std::vector<int> candidates,
                      AugmentedLagrangianOptions options = {});

  ContactStep solve(const PlatePair& plates, State& state, double tolerance) override;
  const Problem& problem() const override { return problem_; }
  Constraints constraints(const State& state) const override {
    return problem_.constraints_at(state.x);
  }
  const std::vector<int>& candidates() const override { return candidates_; }

 private:
  class System;
  void set_terms();
  bool equilibrate(State& state, double tolerance, ContactStep& step);
  double update_multipliers(const State& state);
  void finish(const PlatePair& plates, const State& state, ContactStep& step) const;

  Problem problem_;
  SaddleSolver& solver_;
  SaddleMatrix matrix_;
  std::vector<int> candidates_;
  AugmentedLagrangianOptions options_;
  std::shared_ptr<PlateTerm> plate_;
};

}  // namespace breast
