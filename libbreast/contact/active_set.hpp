// Contact of a body with two plates at one plate position: a primal-dual active set merged with
// Newton's method. Touching nodes have their normal displacement eliminated exactly, so a solution
// neither penetrates nor depends on a penalty. Friction, where asked for, is a force on them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/friction.hpp"
#include "contact/solver.hpp"

namespace breast {

struct ActiveSetOptions {
  int max_iterations = 30;    ///< without a slip
  int most_iterations = 150;  ///< with one
  /// In the first sweeps violated nodes are added and pulling nodes dropped together; later,
  /// pulling nodes are dropped only at convergence, which cannot cycle.
  int free_sweeps = 12;
  double gap_tolerance = 1e-8;  ///< mm
  double volume_tolerance = 1e-9;
  Friction friction;
};

class ActiveSet : public ContactSolver {
 public:
  /// `candidates`: nodes that may touch (skin, not held).
  ActiveSet(ContactBody& body, std::vector<int> candidates, ActiveSetOptions options = {});

  /// Equilibrium of `state` with the plates as they stand. On failure `state` is unspecified; the
  /// memory must be restored by the caller.
  StepResult solve(const PlatePair& plates, BodyState& state, double tolerance) override;

  const std::vector<int>& candidates() const override { return candidates_; }

  /// Force (µN) of the plate on each candidate along its normal, zero where free.
  std::vector<double> normal_forces(const PlatePair& plates, const BodyState& state,
                                    const BodyForces& forces) const override;
  std::vector<Vec3> friction_forces(const PlatePair& plates, const BodyState& state) const override;

 private:
  struct Sweep;
  static bool begins_badly(const StepResult& result, double first_imbalance);
  FrictionForce friction_at(const PlatePair& plates, std::size_t candidate, const Vec3& x,
                            const Vec3& normal) const;
  bool follow_bounds(const PlatePair& plates, const BodyState& state, const BodyForces& forces,
                     const Sweep& now);
  void slide_anchors(const PlatePair& plates, const BodyState& state);
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
  std::vector<int> toggles_;
};

}  // namespace breast
