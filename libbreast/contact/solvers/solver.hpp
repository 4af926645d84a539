// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of the contact methods: the equilibrium at one plate position, and what a method reports
// about it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "contact/plates.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/scene.hpp"
#include "solve/newton.hpp"
#include "solve/problem.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// Relative residual of the volume equation in each linearised solve of contact; the next iteration
/// takes up the remainder.
inline constexpr double contact_volume_accuracy = 1e-4;
/// The friction bounds follow the normal forces once the imbalance is this fraction of their lag.
inline constexpr double balance_to_follow = 0.1;
/// Additional iterations for each one with an indefinite tangent: itself, and one to settle.
inline constexpr int slip_allowance = 2;

/// A solve that may fail fast is abandoned if the first step has to be shorter than `first_step`,
/// or if after `iterations` the imbalance is still more than `remainder` of the first.
struct BadBeginning {
  double first_step = 0, remainder = 0;
  int iterations = 0;

  /// True of a solve whose imbalance is `now` and was `first` after one iteration.
  bool seen_in(const NewtonResult& so_far, double now, double first) const {
    const int made = int(so_far.iterations.size());
    if (made == 1) return so_far.iterations.back().step_length < first_step;
    return made == iterations && now > remainder * first;
  }
};

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
  std::vector<PressedPoint> pressed;   ///< nodes or points of faces under pressure, when converged
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
  double deepest = 0;  ///< penetration of the last solution, mm; of plates that press on faces
  double penalty = 0;  ///< of the augmented Lagrangian, µN/mm; of plates that press on faces, Pa/mm
  /// Points at which friction holds the nodes, relative to the plate's shift, and the positions of
  /// free nodes, mm; with friction only.
  std::vector<Vec3> anchors;
  std::vector<double> bounds;  ///< largest friction forces, µN; with friction only
  PlatePair plates;  ///< of the last solution; with friction between faces and plates only
};

/// Solver for one plate position: an ActiveSet, or another method.
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
  /// The nodes that may touch a plate.
  virtual const std::vector<int>& candidates() const = 0;
  /// Whether a position that begins badly may be abandoned at once, because a closer one can be
  /// tried.
  void set_fail_fast(bool fail_fast) { fail_fast_ = fail_fast; }

  /// The faces whose area counts as contact area.
  virtual std::vector<Face> contact_faces(const HexTopology& mesh) const;
  /// Relative steps in which force, mean pressure and area change from one position to the next, so
  /// that a target is not met more closely.
  virtual double resolution() const { return 0; }
  /// Adds what this method leaves in the record of its solution, besides poses and forces.
  virtual void fill_record(const State& /*solution*/, ContactRecord& /*record*/) const {}
  /// The contact of the last solve, with a fixed touching set, for the estimate of the discretisation
  /// error; nothing if the method has no such set. Mesh and state must outlive it.
  virtual std::optional<ContactEstimate> for_estimate(const HexMesh& mesh, const PlatePair& plates,
                                                      const State& solution) const;

 protected:
  /// The candidates under pressure, as points.
  std::vector<PressedPoint> pressed_nodes(const PlatePair& plates, const State& solution,
                                          const std::vector<NodalContact>& contacts) const;

  ContactMemory memory_;
  bool fail_fast_ = false;
};

/// Contact of faces, exact contact of nodes, or contact of nodes by the paper's augmented
/// Lagrangian.
enum class ContactMethod { surface, active_set, augmented_lagrangian };

/// `friction` is Coulomb's coefficient; the augmented Lagrangian has no friction. `saddle` must
/// outlive the result.
std::unique_ptr<ContactSolver> make_contact_solver(ContactMethod method, double friction,
                                                   const Scene& scene, const Problem& body,
                                                   SaddleSolver& saddle);

}  // namespace breast
