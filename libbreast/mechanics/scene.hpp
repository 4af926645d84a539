// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanical model of one breast (the scene): its material laws, boundary conditions and loads,
// as terms and constraints. What is absent costs nothing: without skin there is no membrane,
// without springs no support, and with a fixed wall no sliding.
//
//     Scene scene(mesh, options);
//     LoadedProblem loaded = scene.problem(scene.gravity_force(g));
//     loaded.problem.add(...);                 // contact adds its terms to a copy
//     State state = scene.rest();
//     EquilibriumResult result = equilibrate(loaded.problem, solver, matrix, state);
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mechanics/supports/effects.hpp"
#include "mechanics/terms/dead_load.hpp"
#include "mechanics/terms/solid.hpp"
#include "solve/problem.hpp"

namespace breast {

/// The constraints of the supports that do not depend on the deformed shape.
Constraints wall_constraints(const HexMesh& mesh, const MechanicsOptions& options);

/// A problem together with its load, which may change.
struct LoadedProblem {
  Problem problem;
  std::shared_ptr<DeadLoad> load;
  double stiffness_force = 1;  ///< scale of the residual if there is no load, µN

  /// Sets the nodal forces (µN, 3 per node) and the norm with which residuals are compared.
  void set_load(const Eigen::VectorXd& force);
};

/// What a part of a body takes from the whole, where several processes share it.
struct PartOfBody {
  Constraints walls;
  std::vector<int> sliding;  ///< nodes of the part that slide on the chest wall
  std::shared_ptr<const Sharing> sharing;
};

class Scene {
 public:
  /// The mesh must outlive the scene (its sets, tissues and imaged shape are read). Throws Error
  /// (input) if mesh and options do not agree.
  Scene(const HexMesh& mesh, const MechanicsOptions& options,
        TangentStorage storage = TangentStorage::assembled);
  /// A part of a body; options.wall_surface is the wall of the whole. Functions that return a sum
  /// over the body are collective.
  Scene(const HexMesh& mesh, const MechanicsOptions& options, PartOfBody part);

  const HexMesh& mesh() const { return mesh_; }
  const MechanicsOptions& options() const { return options_; }
  const Solid& solid() const { return *solid_; }
  const SupportEffects& supports() const { return supports_; }
  /// Whether nodes stay on the chest-wall surface.
  bool slides() const { return sliding_ != nullptr; }
  /// The constraints that do not depend on where the body is.
  const Constraints& walls() const { return walls_; }
  int nodes() const { return solid_->space()->nodes(); }
  long unknowns() const;  ///< free displacements and pressures
  /// Mean edge of an element of the imaged shape, mm, and the largest shear modulus at rest, Pa.
  double element_size() const;
  double stiffest() const;

  /// Terms and constraints of this scene under nodal forces (µN, 3 per node).
  LoadedProblem problem(const Eigen::VectorXd& force) const;
  /// The same, but the corners of elements resist changes of volume less: a problem with a close solution
  /// that is easier to find. They do resist, so that no element of this solution is turned inside out.
  LoadedProblem problem_with_soft_corners(const Eigen::VectorXd& force) const;
  bool corners_resist() const { return corners_ != nullptr; }
  /// Nodal gravity forces, µN (3 per node), from the imaged shape, with those of the supports'
  /// loads. `gravity`: mm/s², LPS.
  Eigen::VectorXd gravity_force(const Vec3& gravity) const;
  /// Weight of the body alone under gravity (mm/s²), µN.
  Vec3 weight(const Vec3& gravity) const;
  /// A force derived from the stiffness, as a scale of the residual if there is no load, µN.
  double stiffness_force() const;
  /// The state of `shape` (3 per node) without stress.
  State at_rest(const Eigen::VectorXd& shape) const {
    return {shape, shape, solid_->rest_pressure()};
  }

 private:
  double volume() const;
  LoadedProblem problem_with(const std::shared_ptr<const Term>& corners,
                             const Eigen::VectorXd& force) const;
  void add_terms(TangentStorage storage, const std::vector<int>& sliding);

  const HexMesh& mesh_;
  MechanicsOptions options_;
  std::shared_ptr<const Solid> solid_;
  std::shared_ptr<const Term> corners_;  // null if they resist no change of volume
  std::shared_ptr<const Term> membrane_;
  SupportEffects supports_;
  std::shared_ptr<const SlidingNodes> sliding_;
  Constraints walls_;
  std::shared_ptr<const Sharing> sharing_;  // null: the whole body
};

}  // namespace breast
