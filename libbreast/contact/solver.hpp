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
  double residual = 0;              ///< relative, at the end
  double worst_penetration = 0;     ///< mm, over all candidates
  BodyForces forces;
  std::vector<NewtonRecord> history;
  Eigen::VectorXd failed_trial;  ///< positions of the first refused trial of a failed step
};

/// Solves one plate position: an ActiveSet, or another method to compare with.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  virtual StepResult solve(const PlatePair& plates, BodyState& state, double tolerance) = 0;
  /// Per candidate normal plate force (µN) and plate (−1 none).
  virtual std::vector<double> normal_forces(const PlatePair& plates, const BodyState& state,
                                            const BodyForces& forces) const = 0;
  virtual const std::vector<signed char>& touching() const = 0;
  virtual void set_touching(std::vector<signed char> touching) = 0;
  virtual const std::vector<int>& candidates() const = 0;
};

}  // namespace breast
