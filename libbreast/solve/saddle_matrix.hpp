// SPDX-License-Identifier: GPL-3.0-or-later
// The assembled matrices of incompressible equilibrium: K + κBᵀM⁻¹B, B, M and c of saddle.hpp.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solve/node_matrix.hpp"

namespace breast {

/// Dense rows of every element with respect to its nodes: B, and similarly ∂θ/∂X.
struct ElementRows {
  const Cells* cells = nullptr;
  int rows = 0;                ///< pressures per element: 1 or 4
  std::vector<double> values;  ///< per element rows × 3n, column-major

  void resize(const Cells& over, int rows_per_element);
  Eigen::Map<const Eigen::MatrixXd> at(int element) const;
  Eigen::Map<Eigen::MatrixXd> at(int element);
  Eigen::VectorXd apply(const Eigen::VectorXd& u) const;            ///< B u
  Eigen::VectorXd apply_transpose(const Eigen::VectorXd& p) const;  ///< Bᵀ p
};

/// The data that do not change with the state: M⁻¹ per element (rows × rows) and c = 1/bulk
/// modulus.
struct PressureSpace {
  int rows = 0;
  std::vector<double> mass, inverse_mass;  ///< per element rows × rows
  Eigen::VectorXd compliance;              ///< c per element, 1/Pa
  int elements() const { return int(compliance.size()); }
  /// Of an element of the imaged shape, mm³: the first basis function is one.
  double volume(int e) const { return mass[std::size_t(e) * rows * rows]; }
  Eigen::Map<const Eigen::MatrixXd> mass_at(int e) const;
  Eigen::Map<const Eigen::MatrixXd> inverse_at(int e) const;
  /// s_e M_e q_e or s_e M_e⁻¹ q_e with one factor s per element.
  Eigen::VectorXd multiply(const Eigen::VectorXd& q, const Eigen::VectorXd& factor) const;
  Eigen::VectorXd divide(const Eigen::VectorXd& q, const Eigen::VectorXd& factor) const;
};

struct SaddleMatrix {
  NodeMatrix stiffness;    ///< K + κ Bᵀ M⁻¹ B, global axes, without constraints
  ElementRows divergence;  ///< B
  Eigen::VectorXd kappa;   ///< κ per element, Pa
  Eigen::VectorXd
      shear;  ///< present shear modulus μ per element, Pa; at rest where bulk moduli are finite
  Eigen::VectorXd diagonal;  ///< of K without κ, made positive: the measure of a shift
  std::shared_ptr<const PressureSpace> space;
  Eigen::VectorXd positions;  ///< of the nodes, mm: rigid motions for a multigrid

  /// K u without the κ term (for reactions and bordering).
  Eigen::VectorXd multiply_unaugmented(const Eigen::VectorXd& u) const;
};

}  // namespace breast
