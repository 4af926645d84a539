// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/skin_state.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/gather.hpp"
#include "fem/membrane_kernel.hpp"
#include "material/stability.hpp"
#include "mechanics/deformation.hpp"

namespace breast {

namespace {

/// A tissue that is strained beyond the stable range of its law has no resistance to reckon with, which is said elsewhere.
/// This fraction of its shear modulus keeps the length of wrinkles finite.
constexpr double least_remaining = 0.01;

// Area elements √det a at the rule's points, times its weights.
template <int N>
Eigen::Matrix<double, QuadRule<N>::points, 1> areas(const Eigen::Matrix<double, 3, N>& x) {
  const QuadRule<N>& rule = QuadRule<N>::get();
  Eigen::Matrix<double, QuadRule<N>::points, 1> out;
  for (int q = 0; q < QuadRule<N>::points; ++q) {
    const Eigen::Matrix<double, 3, 2> t = x * rule.gradients[q].transpose();
    out[q] = rule.weight[q] * std::sqrt((t.transpose() * t).determinant());
  }
  return out;
}

/// Shear modulus (Pa) of the tissue of an element, as it is deformed, in the direction in which it is weakest. Tissue that
/// stiffens resists wrinkles of the skin by more than it does at rest.
double beneath(const HexMesh& mesh, const MaterialSet& materials, int element,
               const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed) {
  const Law& law = materials.law(mesh.tissue[std::size_t(element)]);
  const Mat3 b = isochoric_stretch_at_centre(mesh, element, reference, deformed);
  return law.shear_modulus() * std::max(least_remaining, weakest_shear(law, b));
}

template <int N>
SkinState state_of(const HexMesh& mesh, const MaterialSet& materials,
                   const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed,
                   const std::vector<double>& pressure) {
  const auto presses = [&](int node) { return pressure[std::size_t(node)] > 0; };
  SkinState state;
  double total = 0;
  for (std::size_t f = 0; f < mesh.skin_faces.size(); ++f) {
    const std::vector<int> nodes = face_nodes(mesh, mesh.skin_faces[f]);
    MembraneInput<N> in;
    in.reference = gather<N>(nodes.data(), reference);
    in.deformed = gather<N>(nodes.data(), deformed);
    in.volume = mesh.skin_thickness[f] * areas<N>(gather<N>(nodes.data(), mesh.imaged));
    in.law = &materials.law(Tissue::skin);
    in.skin = materials.skin;
    const double area = areas<N>(in.deformed).sum();
    const double resultant = membrane_resultants<N>(in)[0];  // Pa·mm
    ++state.faces;
    total += area;
    // Rounding gives resultants of either sign in a skin at rest.
    if (!(resultant < -1e-9 * materials.law(Tissue::skin).shear_modulus())) continue;
    ++state.compressed;
    state.compressed_share += area;
    state.least_resultant_N_per_m = std::min(state.least_resultant_N_per_m, 1e-3 * resultant);
    if (!pressure.empty() && std::ranges::all_of(nodes, presses)) continue;
    const double wrinkle =
        std::numbers::pi * -resultant /
        beneath(mesh, materials, mesh.skin_faces[f].element, reference, deformed);
    state.longest_wrinkle_mm = std::max(state.longest_wrinkle_mm, wrinkle);
    if (wrinkle >= 2 * std::sqrt(area)) {
      ++state.wrinkling;
      state.wrinkling_share += area;
    }
  }
  if (total > 0) {
    state.compressed_share /= total;
    state.wrinkling_share /= total;
  }
  return state;
}

}  // namespace

SkinState skin_state(const HexMesh& mesh, const MaterialSet& materials,
                     const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed,
                     const std::vector<double>& pressure) {
  if (mesh.skin_model != SkinModel::membrane) return {};
  SkinState state = mesh.order == 1 ? state_of<4>(mesh, materials, reference, deformed, pressure)
                                    : state_of<9>(mesh, materials, reference, deformed, pressure);
  state.folds = skin_folds(mesh, deformed);
  return state;
}

}  // namespace breast
