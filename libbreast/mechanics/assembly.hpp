// Forces and derivatives of the breast at a triple (reference X, deformed x, pressure p), summed
// over elements and skin faces. Element kind is chosen once; there is no skin loop without skin.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mechanics/mechanics.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/newton.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// ∂r/∂X, ∂θ/∂X and ∂θ/∂x, kept per element (they are applied, never factorised).
struct ReferenceTangent {
  const Cells* elements = nullptr;
  const Cells* faces = nullptr;
  std::vector<double> element_matrices, face_matrices;  ///< 3n × 3n each, column-major
  ElementRows b_x, b;
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;            ///< K_X v
  Eigen::VectorXd apply_transpose(const Eigen::VectorXd& v) const;  ///< K_Xᵀ v
};

/// What one pass over the elements should fill; null means not wanted.
struct AssemblyRequest {
  const Eigen::VectorXd* kappa = nullptr;  ///< fills SaddleForces::augmented
  SaddleMatrix* matrix = nullptr;
  double augmentation = 0;  ///< κ/μ of the matrix; 0: what suits the linear solver
  ReferenceTangent* reference = nullptr;
};

class Assembly {
 public:
  virtual ~Assembly() = default;

  /// Internal forces (external load not included), volume residual and what the request names.
  /// `reference` is X (3 per node). Not valid: stops at once, the request's targets are undefined.
  virtual SaddleForces evaluate(const Eigen::VectorXd& reference, const SaddleState& state,
                                const AssemblyRequest& request) const = 0;
  /// Mean pressure (Pa) and mean det F per element.
  virtual std::vector<double> mean_pressure(const Eigen::VectorXd& p) const = 0;
  virtual std::vector<double> mean_det_f(const Eigen::VectorXd& reference,
                                         const Eigen::VectorXd& deformed) const = 0;

  SaddleMatrix make_matrix() const;
  /// The linear solver matrices are made for: multigrid where the options say so, else direct.
  LinearSolver solver() const { return solver_; }
  const std::shared_ptr<const NodePattern>& pattern() const { return pattern_; }
  const std::shared_ptr<const PressureSpace>& pressures() const { return space_; }
  const Cells& elements() const { return cells_; }
  int nodes() const { return pattern_->nodes(); }
  /// Volume of each element of the imaged shape, mm³.
  const std::vector<double>& imaged_volume() const { return imaged_volume_; }
  /// Mass of each node, g: ∫ρN dv on the imaged shape, once and for all.
  const Eigen::VectorXd& nodal_mass() const { return nodal_mass_; }
  /// Pressure that balances the law at rest (plain invariants), zero for isochoric ones.
  const Eigen::VectorXd& rest_pressure() const { return rest_pressure_; }

 protected:
  LinearSolver solver_ = LinearSolver::direct;
  Cells cells_, face_cells_;
  std::shared_ptr<const NodePattern> pattern_;
  std::shared_ptr<const ScatterMap> element_map_, face_map_;
  std::shared_ptr<const PressureSpace> space_;
  std::vector<double> imaged_volume_;
  Eigen::VectorXd nodal_mass_, rest_pressure_;
};

/// Throws Error (input) when mesh and options do not fit (element order, skin data, folded imaged
/// element).
std::unique_ptr<Assembly> make_assembly(const HexMesh& mesh, const MechanicsOptions& options);

/// Nodal fields between meshes and solvers.
Eigen::VectorXd flatten(const std::vector<Vec3>& nodal);
std::vector<Vec3> unflatten(const Eigen::VectorXd& flat);

}  // namespace breast
