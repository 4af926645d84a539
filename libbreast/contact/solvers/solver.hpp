// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the contact methods: the equilibrium at one plate position.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "contact/plates.hpp"
#include "contact/pressed_point.hpp"
#include "solve/newton.hpp"
#include "solve/problem.hpp"

namespace breast {

/// Relative residual of the volume equation in each linearised solve of contact; the next iteration
/// takes up the remainder.
inline constexpr double contact_volume_accuracy = 1e-4;

/// The forces of the plates on one candidate.
struct NodalContact {
  int plate = -1;     ///< 0 paddle, 1 detector; −1: touches neither
  double normal = 0;  ///< along the plate's normal there, µN
  /// Perpendicular to that normal, µN: friction and, for a face on a rounded edge, the contribution
  /// of the pressure beside the node.
  Vec3 tangential{0, 0, 0};
};

struct ContactStep : NewtonResult {
  Forces forces;  ///< of the final state, plates and friction included
  /// Number of iterations after a first equilibrium, which do not depend on the step of the plates.
  int corrections = 0;
  bool hurried = false;  ///< abandoned because it began badly (set_fail_fast)
  /// For a state to be reported: relative difference between the friction bounds and those of its
  /// own normal forces.
  double friction_lag = 0;
  /// The equilibrium at this position before the plates became stiffer; absent if they did not.
  std::optional<State> softer;
  double worst_penetration = 0;        ///< mm, over all candidates
  std::vector<NodalContact> contacts;  ///< per candidate, when converged
  std::vector<PressedPoint> pressed;   ///< when converged, of faces; empty where nodes touch
  Eigen::VectorXd failed_trial;        ///< positions of the first refused trial of a failed step

  /// Appends the iterations of one of several solves and adopts its outcome.
  void append(const NewtonResult& part) {
    iterations.insert(iterations.end(), part.iterations.begin(), part.iterations.end());
    indefinite += part.indefinite;
    residual = part.residual;
    stop = part.stop;
    reason = part.reason;
  }
};

/// State of a contact method that is kept from one plate position to the next, per candidate.
struct ContactMemory {
  std::vector<signed char> touching;  ///< −1 free, 0 touches the paddle, 1 the detector
  std::vector<double> multipliers;    ///< µN per unit gap gradient
  double penalty = 0;  ///< of the augmented Lagrangian, µN/mm; of plates that press on faces, Pa/mm
  /// Points at which friction holds the nodes, relative to the plate's shift, and the positions of
  /// free nodes, mm; with friction only.
  std::vector<Vec3> anchors;
  std::vector<double> bounds;  ///< largest friction forces, µN; with friction only
  PlatePair plates;  ///< of the last solution; with friction between faces and plates only
};

/// Solver for one plate position: an ActiveSet, or another method for comparison.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  /// Finds the equilibrium of `state` with the plates at their present position. On failure `state`
  /// is unspecified and the caller must restore the memory.
  virtual ContactStep solve(const PlatePair& plates, State& state, double tolerance) = 0;
  /// The problem of the last solve, including the plates' terms; and its constraints at a state:
  /// those of the body, and the normals of touching nodes.
  virtual const Problem& problem() const = 0;
  virtual Constraints constraints(const State& state) const = 0;
  const std::vector<signed char>& touching() const { return memory_.touching; }
  const ContactMemory& memory() const { return memory_; }
  /// Restores what memory() returned after a converged solve.
  virtual void restore(ContactMemory memory) { memory_ = std::move(memory); }
  virtual const std::vector<int>& candidates() const = 0;
  /// Whether a position that begins badly may be abandoned at once, because a closer one can be
  /// tried.
  void set_fail_fast(bool fail_fast) { fail_fast_ = fail_fast; }

 protected:
  ContactMemory memory_;
  bool fail_fast_ = false;
};

}  // namespace breast
