// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of one hexahedral element: residual, volume constraint and their exact derivatives
// with respect to the deformed and the reference shape. Q1 (8 nodes, 1 pressure) and Q2 (27 nodes,
// 4 pressures) share the code.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/types.hpp"
#include "material/law.hpp"

namespace breast {

/// Shape functions at the Gauss points (2³ or 3³) of the unit cube [-1,1]³.
template <int N>
struct HexRule {
  static constexpr int points = N == 8 ? 8 : 27;
  std::array<double, points> weight;
  std::array<Eigen::Matrix<double, N, 1>, points> values;
  std::array<Eigen::Matrix<double, 3, N>, points> gradients;  ///< ∂N/∂ξ
  std::array<Vec3, points> local;
  static const HexRule& get();
};

/// The quantities requested from the kernel.
struct HexDemand {
  bool tangent = false;            ///< K and B
  bool reference_tangent = false;  ///< K_X and B_X
};

template <int N, int P>
struct HexInput {
  Eigen::Matrix<double, 3, N> reference, deformed;  ///< X, x: mm
  Eigen::Matrix<double, P, 1> pressure;             ///< Pa
  /// Pressure basis at the Gauss points, fixed on the imaged shape.
  Eigen::Matrix<double, P, HexRule<N>::points> basis;
  const Law* law = nullptr;
  bool isochoric = true;
};

template <int N, int P>
struct HexOutput {
  bool valid = false;  ///< false: folded, or the law is out of range
  double energy = 0;
  double min_det = 0, max_det = 0;  ///< of det F over the Gauss points
  double volume = 0, reference_volume = 0;
  Eigen::Matrix<double, 3, N> residual;     ///< µN
  Eigen::Matrix<double, P, 1> theta;        ///< Σ ψ (j_x − j_X) w, mm³
  Eigen::Matrix<double, 3 * N, 3 * N> k;    ///< ∂residual/∂x
  Eigen::Matrix<double, P, 3 * N> b;        ///< ∂θ/∂x
  Eigen::Matrix<double, 3 * N, 3 * N> k_x;  ///< ∂residual/∂X
  Eigen::Matrix<double, P, 3 * N> b_x;      ///< ∂θ/∂X
  double gradient_square = 0;               ///< Σ_q w Σ_a |∇_x N_a|²: measures stiffness
};

/// Fills `out`: always r, θ and B; K and the reference derivatives if requested.
template <int N, int P>
void hex_kernel(const HexInput<N, P>& in, const HexDemand& demand, HexOutput<N, P>& out);

extern template void hex_kernel<8, 1>(const HexInput<8, 1>&, const HexDemand&, HexOutput<8, 1>&);
extern template void hex_kernel<27, 4>(const HexInput<27, 4>&, const HexDemand&, HexOutput<27, 4>&);
extern template struct HexRule<8>;
extern template struct HexRule<27>;

}  // namespace breast
