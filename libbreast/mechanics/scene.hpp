// A scene: one breast, its laws, what holds it and what loads it. Terms that are absent cost
// nothing: without skin there is no membrane, without gravity no load. Contact builds on this:
//
//     Scene scene(mesh, options);
//     ForwardProblem problem(scene, flatten(mesh.reference), scene.gravity_force(g));
//     SaddleMatrix matrix = problem.make_matrix();
//     SaddleSolver solver(problem.pattern());
//     SaddleState state{x, p};                 // e.g. of the gravity-loaded breast
//     problem.tangent(state, forces, matrix);  // forces.r includes the load; false: inadmissible
//     Constraints held = scene.walls();        // then held.hold_normal(node, n, gap) for plates
//     matrix.stiffness.add_to_node(node, curvature);
//     solver.factorise(matrix, held);
//     SaddleStep step = solver.solve(matrix, forces.r, forces.theta);
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mechanics/assembly.hpp"
#include "solve/newton.hpp"

namespace breast {

/// Pectoral faces held; cut faces free, held, or rolling on their mean normal of the imaged shape.
Constraints wall_constraints(const HexMesh& mesh, Cut cut);

class Scene {
 public:
  /// The mesh must outlive the scene (its sets, tissues and imaged shape are read).
  Scene(const HexMesh& mesh, const MechanicsOptions& options);

  const HexMesh& mesh() const { return mesh_; }
  const MechanicsOptions& options() const { return options_; }
  const Assembly& assembly() const { return *assembly_; }
  int nodes() const { return assembly_->nodes(); }
  long unknowns() const;  ///< displacements not held, and pressures

  /// Pectoral faces held; cut faces free, held, or rolling on their mean normal of the imaged
  /// shape.
  const Constraints& walls() const { return walls_; }
  /// Nodal gravity forces, µN (3 per node), from the imaged shape. `gravity`: mm/s², LPS.
  Eigen::VectorXd gravity_force(const Vec3& gravity) const;
  /// A force that stands for the stiffness of the scene where there is no load, µN.
  double stiffness_force() const { return stiffness_force_; }

 private:
  const HexMesh& mesh_;
  MechanicsOptions options_;
  std::unique_ptr<Assembly> assembly_;
  Constraints walls_;
  double stiffness_force_ = 1;
};

/// Equilibrium in x and p with X given, under a constant nodal load.
class ForwardProblem final : public SaddleProblem {
 public:
  ForwardProblem(const Scene& scene, Eigen::VectorXd reference, Eigen::VectorXd load);

  std::shared_ptr<const NodePattern> pattern() const override;
  SaddleMatrix make_matrix() const override;
  SaddleForces forces(const SaddleState& state, const Eigen::VectorXd* kappa) const override;
  bool tangent(const SaddleState& state, SaddleForces& forces, SaddleMatrix& matrix) const override;
  double load_norm() const override { return load_norm_; }
  double volume_scale(int element) const override;

  void set_load(const Eigen::VectorXd& load);
  const Eigen::VectorXd& reference() const { return reference_; }

 private:
  const Scene& scene_;
  Eigen::VectorXd reference_, load_;
  double load_norm_ = 1;
};

}  // namespace breast
