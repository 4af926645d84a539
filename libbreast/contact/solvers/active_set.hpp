// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of a body with two plates at one plate position: a primal-dual active set merged with
// Newton's method. Touching nodes have their normal displacement eliminated exactly, so a solution
// neither penetrates at a node nor depends on a penalty. Friction, if any, is a term.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/solvers/solver.hpp"
#include "contact/terms/friction.hpp"
#include "contact/terms/plate.hpp"

namespace breast {

struct ActiveSetOptions {
  int max_iterations = 30;    ///< if there is no snap-through
  int most_iterations = 150;  ///< if there is one
  /// Number of first iterations in which nodes that penetrate a plate are added to the set and nodes in
  /// tension are removed at the same time. Later, nodes in tension are removed only at convergence, so
  /// that the set cannot cycle.
  int free_sweeps = 12;
  double gap_tolerance = 1e-8;  ///< mm
  double volume_tolerance = 1e-9;
  Friction friction;
};

class ActiveSet : public ContactSolver {
 public:
  /// `body`: everything but the plates. `candidates`: nodes that may touch (skin, not held).
  /// `solver` must outlive this.
  ActiveSet(const Problem& body, SaddleSolver& solver, std::vector<int> candidates,
            ActiveSetOptions options = {});

  ContactStep solve(const PlatePair& plates, State& state, double tolerance) override;
  const Problem& problem() const override { return problem_; }
  Constraints constraints(const State& state) const override;
  const std::vector<int>& candidates() const override { return candidates_; }
  std::optional<ContactEstimate> for_estimate(const HexMesh& mesh, const PlatePair& plates,
                                              const State& solution) const override;

 private:
  class System;
  void set_terms(const PlatePair& plates);

  Problem problem_;
  SaddleSolver& solver_;
  SaddleMatrix matrix_;
  std::vector<int> candidates_;
  ActiveSetOptions options_;
  PlatePair plates_;  // of the last solve
  std::shared_ptr<PlateTerm> plate_;
  std::shared_ptr<FrictionTerm> friction_;  // null: none
};

}  // namespace breast
