// SPDX-License-Identifier: GPL-3.0-or-later
// One plate position: what every contact method answers.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/plates.hpp"
#include "contact/pressed_point.hpp"
#include "solve/newton.hpp"
#include "solve/problem.hpp"

namespace breast {

/// Relative residual of the volume equation in each linearised solve of contact: its remainder is
/// taken up by the next iteration.
inline constexpr double contact_volume_accuracy = 1e-4;

/// The forces of the plates on one candidate.
struct NodalContact {
  int plate = -1;       ///< 0 paddle, 1 detector; −1: touches neither
  double normal = 0;         ///< along the plate's normal there, µN
  /// At right angles to it, µN: friction, and of a face on a rounded edge what the pressure beside
  /// the node adds.
  Vec3 tangential{0, 0, 0};
};

struct ContactStep : NewtonResult {
  Forces forces;  ///< of the final state, plates and friction included
  /// Of the iterations, those after a first equilibrium, which say nothing of the plates' step.
  int corrections = 0;
  bool hurried = false;          ///< given up at its bad beginning
  /// Of a state to be reported: by how much the bounds of friction differ from those of its own
  /// normal forces, relative.
  double friction_lag = 0;
  double worst_penetration = 0;  ///< mm, over all candidates
  std::vector<NodalContact> contacts;  ///< per candidate, when converged
  std::vector<PressedPoint> pressed;   ///< when converged, of faces; empty where nodes touch
  Eigen::VectorXd failed_trial;        ///< positions of the first refused trial of a failed step

  /// Appends the iterations of one of several solves; how that one ended is how the step stands.
  void append(const NewtonResult& part) {
    iterations.insert(iterations.end(), part.iterations.begin(), part.iterations.end());
    indefinite += part.indefinite;
    residual = part.residual;
    stop = part.stop;
    reason = part.reason;
  }
};

/// What a method carries from one plate position to the next, per candidate.
struct ContactMemory {
  std::vector<signed char> touching;  ///< −1 free, 0 touches the paddle, 1 the detector
  std::vector<double> multipliers;    ///< µN per unit gap gradient
  double penalty = 0;                 ///< µN/mm; augmented Lagrangian only
  std::vector<Vec3> anchors;          ///< where friction holds a node, mm; with friction only
  std::vector<double> bounds;         ///< the most it is held with, µN; with friction only
};

/// Solves one plate position: an ActiveSet, or another method to compare with.
class ContactSolver {
 public:
  virtual ~ContactSolver() = default;
  /// Equilibrium of `state` with the plates as they stand. On failure `state` is unspecified; the
  /// memory must be restored by the caller.
  virtual ContactStep solve(const PlatePair& plates, State& state, double tolerance) = 0;
  /// The problem of the last solve, the plates' terms included; and its constraints at a state: what
  /// is held, and the normals of touching nodes.
  virtual const Problem& problem() const = 0;
  virtual Constraints constraints(const State& state) const = 0;
  const std::vector<signed char>& touching() const { return memory_.touching; }
  const ContactMemory& memory() const { return memory_; }
  /// Goes back to what memory() gave after a converged solve.
  virtual void restore(ContactMemory memory) { memory_ = std::move(memory); }
  virtual const std::vector<int>& candidates() const = 0;
  /// Whether a position that begins badly may be given up at once, since a nearer one can be tried.
  void set_fail_fast(bool fail_fast) { fail_fast_ = fail_fast; }

 protected:
  ContactMemory memory_;
  bool fail_fast_ = false;
};

}  // namespace breast
