// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's method for all problems: the forward, inverse and contact problems differ only in their
// unknowns and convergence criteria (NewtonSystem). The line search is the same for all.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solve/state.hpp"

namespace breast {

/// Reason why a Newton solve ended without convergence.
enum class NewtonStop {
  none,
  folded,  ///< an element turns inside out
  iteration_limit,
  indefinite,        ///< the tangent is far from positive definite
  no_step,           ///< no length along the direction is acceptable
  left_surface,      ///< a node leaves the surface it slides on
  linear_solver,     ///< a linear system was not solved
  singular_inverse,  ///< the linearised inverse problem is singular
};
/// Stable identifier: "", "folded_element", "iteration_limit", "indefinite_tangent",
/// "no_admissible_step", "left_wall_surface", "linear_solver", "singular_inverse".
const char* stop_name(NewtonStop stop);
/// In words, for reports.
const char* describe(NewtonStop stop);

struct NewtonIteration {
  double residual = 0;  ///< relative, after the step
  double residual_before = 0;
  double min_det_F = 0, max_det_F = 0;
  double step_length = 0;  ///< 0: none was acceptable
  double shift = 0;        ///< see Factorisation
  int linear_iterations = 0;
};

struct NewtonResult {
  bool converged = false;
  NewtonStop stop = NewtonStop::none;
  std::string reason;  ///< why not, in words
  std::vector<NewtonIteration> iterations;
  int indefinite = 0;  ///< iterations whose tangent had to be shifted
  int factorisations = 0;
  double residual = 0;  ///< relative, of the final state
};

/// Distance of the present state from a solution.
struct Balance {
  double residual = 0;  ///< of the forces, relative
  double merit = 0;     ///< quantity that a step must reduce
  bool converged = false;
  bool nearly = false;                 ///< acceptable if no further step can be made
  NewtonStop stop = NewtonStop::none;  ///< not none: the solve ends here
  std::string reason;
};

struct NewtonDirection {
  NewtonStop stop = NewtonStop::none;  ///< not none: there is no direction
  std::string reason;
  double slope = 0;  ///< δxᵀ K δx with the tangent of the solve: the predicted descent
  double shift = 0;
  int linear_iterations = 0;
  bool provisional = false;  ///< found with an older factor, so that its failure does not end the
                             ///< solve
};

/// Evaluation of a state at a fraction of the direction.
struct Appraisal {
  double residual = 0;  ///< relative
  double merit = 0;
  double along = 0;  ///< gradient of the augmented energy along the direction
};
struct Trial {
  State state;
  Forces forces;
  Appraisal seen;
};

/// Conditions under which a line search accepts a step, besides a merit below that at the start.
struct LineSearchRule {
  double merit = 0;       ///< at the start
  double tolerance = 0;   ///< residual of a solution
  int most_halvings = 6;  ///< before the direction is given up
  bool any = false;       ///< accept every admissible length
  bool flat_suffices =
      false;  ///< accept a step at whose end the energy is flatter along the direction
  /// The tangent was shifted and the body may snap through: a decrease of energy suffices, and a
  /// step is doubled as long as the slope stays as steep as predicted.
  bool downhill_suffices = false;
  /// The energy has kinks: a penalty that becomes active along the step can be hundreds of times
  /// stiffer than the tangent, so that after several halvings the slope determines the step length.
  /// A step past the minimum along the direction must end flatter than one before it.
  bool kinks = false;
  /// Seek the minimum of the energy along the direction, whatever the merit: with an energy that falls
  /// in every step, steps cannot repeat.
  bool to_minimum = false;
};

class NewtonSystem {
 public:
  virtual ~NewtonSystem() = default;
  /// Distance of the present state from a solution. `so_far` contains the iterations made.
  virtual Balance assess(const NewtonResult& so_far) = 0;
  virtual NewtonDirection direction(const Balance& now) = 0;
  virtual LineSearchRule rule(const NewtonResult& so_far, const Balance& now,
                              const NewtonDirection& direction) const = 0;
  /// The state at `length` times the direction; no value if it is inadmissible. Beyond length 1 the
  /// pressures remain as at 1.
  virtual std::optional<Trial> attempt(double length) = 0;
  virtual void accept(Trial trial) = 0;
  /// Why the last attempt was inadmissible.
  virtual NewtonStop refusal() const { return NewtonStop::folded; }
  /// An element of the present state that is turned inside out at a node or a quadrature point;
  /// −1: none. A state with such an element is not accepted, however small its residual.
  virtual int folded_element() const { return -1; }
};

/// Iterates until the system has converged or stops.
NewtonResult newton(NewtonSystem& system,
                    const std::function<void(const NewtonIteration&)>& watch = {});

}  // namespace breast
