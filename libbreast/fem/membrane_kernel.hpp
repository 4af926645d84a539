// SPDX-License-Identifier: GPL-3.0-or-later
// The kernel of the skin as a membrane on a boundary face, with a law in plane stress and no
// thickness in the mesh. The energy is ∫ t √det a_imaged f(I, d) dξ with I = A^{αβ}a_{αβ} and d =
// det a/det A; for incompressible skin, I1 = I + 1/d and I2 = d + I/d.
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/types.hpp"
#include "fem/hex_kernel.hpp"
#include "material/material_set.hpp"

namespace breast {

template <int N>
struct QuadRule {
  static constexpr int points = N == 4 ? 4 : 9;
  std::array<double, points> weight;
  std::array<Eigen::Matrix<double, N, 1>, points> values;
  std::array<Eigen::Matrix<double, 2, N>, points> gradients;
  static const QuadRule& get();
};

template <int N>
struct MembraneInput {
  Eigen::Matrix<double, 3, N> reference, deformed;
  /// Skin volume at each Gauss point, mm³: t √det a_imaged times the rule's weight, kept for good.
  Eigen::Matrix<double, QuadRule<N>::points, 1> volume;
  const Law* law = nullptr;
  SkinBehaviour skin;
};

template <int N>
struct MembraneOutput {
  bool valid = false;
  double energy = 0;
  Eigen::Matrix<double, 3, N> residual;
  Eigen::Matrix<double, 3 * N, 3 * N> k, k_x;
};

/// Of the demand, only `tangent` and `reference_tangent` are used.
template <int N>
void membrane_kernel(const MembraneInput<N>& in, const HexDemand& demand, MembraneOutput<N>& out);

/// Principal resultants (Pa·mm: force per length of the deformed face) at the centre of the face,
/// the smaller one first; a negative one compresses the skin. Not a number if the law is out of
/// range.
template <int N>
Vec2 membrane_resultants(const MembraneInput<N>& in);

extern template Vec2 membrane_resultants<4>(const MembraneInput<4>&);
extern template Vec2 membrane_resultants<9>(const MembraneInput<9>&);
extern template void membrane_kernel<4>(const MembraneInput<4>&, const HexDemand&,
                                        MembraneOutput<4>&);
extern template void membrane_kernel<9>(const MembraneInput<9>&, const HexDemand&,
                                        MembraneOutput<9>&);
extern template struct QuadRule<4>;
extern template struct QuadRule<9>;

}  // namespace breast
