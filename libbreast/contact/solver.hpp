// One plate position: what every contact method answers.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/body.hpp"
#include "contact/plates.hpp"

namespace breast {

enum class StepOutcome { converged, too_many_iterations, folded, singular, no_descent };
/// In words, for reports.
std::string describe(StepOutcome outcome);

/// One Newton iteration as the path records it.
struct NewtonRecord {
  double residual = 0, min_det_F = 0, max_det_F = 0, step_length = 0;
};

struct StepResult {
  StepOutcome outcome = StepOutcome::converged;
  int iterations = 0, shifted = 0;  ///< shifted: iterations whose tangent was indefinite
  /// Of the iterations, those after a first equilibrium, which say nothing of the plates' step.
  int corrections = 0;
  bool hurried = false;          ///< given up at its bad beginning
  double residual = 0;           ///< relative, at the end
  double worst_penetration = 0;  ///< mm, over all candidates
  BodyForces forces;
  std::vector<NewtonRecord> history;
  Eigen::VectorXd failed_trial;  ///< positions of the first refused trial of a failed step
};

/// What a method carries from one plate position to the next, per candidate.
struct ContactMemory {
  std::vector<signed char> touching;  ///< −1 free, 0 touches the paddle, 1 the detector
  std::vector<double> multipliers;    ///< µN per unit gap gradient; augmented Lagrangian only
  double penalty = 0;                 ///< µN/mm; augmented Lagrangian only
  std::vector<Vec3> anchors;          ///< where friction holds a node, mm; with friction only
  std::vector<double> bounds;         ///< the most it is held with, µN; with friction only
};

/// Solves one plate position: an ActiveSet, or another method to compare with.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  virtual StepResult solve(const PlatePair& plates, BodyState& state, double tolerance) = 0;
  /// Per candidate normal plate force (µN) and plate (−1 none).
  virtual std::vector<double> normal_forces(const PlatePair& plates, const BodyState& state,
                                            const BodyForces& forces) const = 0;
  /// Per candidate friction force of the plate, µN, at right angles to the normal; empty without
  /// friction.
  virtual std::vector<Vec3> friction_forces(const PlatePair&, const BodyState&) const { return {}; }
  const std::vector<signed char>& touching() const { return memory_.touching; }
  const ContactMemory& memory() const { return memory_; }
  /// Goes back to what memory() gave after a converged solve.
  void restore(ContactMemory memory) { memory_ = std::move(memory); }
  virtual const std::vector<int>& candidates() const = 0;
  /// Whether a position that begins badly may be given up at once, since a nearer one can be tried.
  void set_hasty(bool hasty) { hasty_ = hasty; }

 protected:
  ContactMemory memory_;
  bool hasty_ = false;
};

}  // namespace breast
