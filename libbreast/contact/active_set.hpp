// Frictionless contact of a body with two plates at one plate position: a primal-dual active set
// merged with Newton's method. Touching nodes have their normal displacement eliminated exactly, so
// a solution neither penetrates nor depends on a penalty.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/solver.hpp"

namespace breast {

struct ActiveSetOptions {
  int max_iterations = 30;
  /// In the first sweeps violated nodes are added and pulling nodes dropped together; later,
  /// pulling nodes are dropped only at convergence, which cannot cycle.
  int free_sweeps = 12;
  double gap_tolerance = 1e-8;  ///< mm
  double volume_tolerance = 1e-9;
};

class ActiveSet : public ContactSolver {
 public:
  /// `candidates`: nodes that may touch (skin, not held).
  ActiveSet(ContactBody& body, std::vector<int> candidates, ActiveSetOptions options = {});

  /// Equilibrium of `state` with the plates as they stand. On failure `state` is unspecified; the
  /// set of touching nodes must be restored by the caller (touching(), set_touching()).
  StepResult solve(const PlatePair& plates, BodyState& state, double tolerance) override;

  const std::vector<int>& candidates() const override { return candidates_; }
  /// Per candidate: −1 free, 0 touches the paddle, 1 the detector.
  const std::vector<signed char>& touching() const override { return touching_; }
  void set_touching(std::vector<signed char> touching) override { touching_ = std::move(touching); }

  /// Force (µN) of the plate on each candidate along its normal, zero where free.
  std::vector<double> normal_forces(const PlatePair& plates, const BodyState& state,
                                    const BodyForces& forces) const override;

 private:
  struct Sweep;
  bool update(const PlatePair& plates, const BodyState& state, const BodyForces& forces,
              double scale, bool may_drop, bool balanced);
  Sweep measure(const PlatePair& plates, const BodyState& state, const BodyForces& forces) const;
  bool newton_step(const PlatePair& plates, const Sweep& now, BodyState& state, StepResult& result);
  bool line_search(const PlatePair& plates, const Sweep& now, const BodyState& increment,
                   const BodySolve& solve, BodyState& state, StepResult& result);

  ContactBody& body_;
  std::vector<int> candidates_;
  ActiveSetOptions options_;
  double tolerance_ = 1e-9;
  std::vector<signed char> touching_;
  std::vector<int> toggles_;
};

}  // namespace breast
