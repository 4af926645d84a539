// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/membrane_kernel.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "fem/plane_stress.hpp"
#include "mesh/gauss.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

using Mat2 = Eigen::Matrix2d;
using Surface = Eigen::Vector3d;  // components 11, 22, 12 of a surface tensor
using SurfaceTangent = Eigen::Matrix3d;

constexpr int surface_row[3] = {0, 1, 0}, surface_column[3] = {0, 1, 1};

Surface to_surface(const Mat2& a) {
  return {a(0, 0), a(1, 1), a(0, 1)};
}

// (a ⊙ a) of two dimensions.
SurfaceTangent self_product(const Mat2& a) {
  SurfaceTangent out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      const int i = surface_row[r], j = surface_column[r];
      const int k = surface_row[c], l = surface_column[c];
      out(r, c) = 0.5 * (a(i, k) * a(j, l) + a(i, l) * a(j, k));
    }
  }
  return out;
}

// Surface stress per reference skin volume, and its derivatives with respect to E = a/2 of the
// deformed and A/2 of the reference metric (strain-like, doubled shear).
struct SurfaceStress {
  double energy = 0;
  Surface s;
  SurfaceTangent tangent, reference_tangent;
};

bool surface_stress(const Law& law, const SkinBehaviour& skin, const Mat2& body,
                    const Mat2& deformed, SurfaceStress& out) {
  // The unstretched skin is smaller than the shape of the body over which it is stretched.
  const double shrink = 1 / ((1 + skin.prestretch) * (1 + skin.prestretch));
  const Mat2 reference = shrink * body;
  const double det_reference = reference.determinant(), det_deformed = deformed.determinant();
  if (!(det_reference > 0) || !(det_deformed > 0)) return false;
  const Mat2 up = reference.inverse(), current = deformed.inverse();
  const double d = det_deformed / det_reference, i = (up * deformed).trace();
  PlaneStress f;
  if (!(skin.kept < 1 ? tension_field(law, skin.kept, skin.smoothing, i, d, f)
                      : plane_stress(law, i, d, f))) {
    return false;
  }
  const Surface a_up = to_surface(up), a_now = to_surface(current);
  const Surface back = to_surface(up * deformed * up);  // −∂I/∂A
  out.energy = f.f;
  out.s = 2 * (f.fi * a_up + d * f.fd * a_now);
  // ∂I/∂E = 2A⁻¹, ∂d/∂E = 2d a⁻¹, ∂a⁻¹/∂E = −2 a⁻¹⊙a⁻¹.
  const SurfaceTangent mixed = a_up * a_now.transpose();
  out.tangent = 4 * (f.fii * a_up * a_up.transpose() + d * f.fid * (mixed + mixed.transpose()) +
                     (d * f.fd + d * d * f.fdd) * a_now * a_now.transpose() -
                     d * f.fd * self_product(current));
  // ∂I/∂(A/2) = −2 A⁻¹aA⁻¹, ∂d/∂(A/2) = −2d A⁻¹, ∂A⁻¹/∂(A/2) = −2 A⁻¹⊙A⁻¹.
  const Surface on_up = -2 * (f.fii * back + d * f.fid * a_up);
  const Surface on_now = -2 * d * (f.fid * back + (f.fd + d * f.fdd) * a_up);
  out.reference_tangent =
      2 * shrink *
      (a_up * on_up.transpose() + a_now * on_now.transpose() - 2 * f.fi * self_product(up));
  return std::isfinite(out.energy);
}

// Rows of δ(a/2) in components 11, 22, 2·12 for the tangent vectors t (3 × 2).
template <int N>
Eigen::Matrix<double, 3, 3 * N> metric_rows(const Eigen::Matrix<double, 3, 2>& t,
                                            const Eigen::Matrix<double, 2, N>& gradient) {
  Eigen::Matrix<double, 3, 3 * N> rows;
  for (int b = 0; b < N; ++b) {
    for (int i = 0; i < 3; ++i) {
      rows(0, 3 * b + i) = t(i, 0) * gradient(0, b);
      rows(1, 3 * b + i) = t(i, 1) * gradient(1, b);
      rows(2, 3 * b + i) = t(i, 0) * gradient(1, b) + t(i, 1) * gradient(0, b);
    }
  }
  return rows;
}

}  // namespace

template <int N>
const QuadRule<N>& QuadRule<N>::get() {
  static const QuadRule rule = [] {
    QuadRule made;
    const std::vector<GaussSquarePoint> gauss = gauss_square(N == 4 ? 2 : 3);
    for (int q = 0; q < points; ++q) {
      const QuadShape shape = quad_shape(N == 4 ? 1 : 2, gauss[q].at);
      made.weight[q] = gauss[q].weight;
      made.values[q] = shape.values;
      made.gradients[q] = shape.gradients;
    }
    return made;
  }();
  return rule;
}

template <int N>
void membrane_kernel(const MembraneInput<N>& in, const HexDemand& demand, MembraneOutput<N>& out) {
  const QuadRule<N>& rule = QuadRule<N>::get();
  out.valid = false;
  out.energy = 0;
  out.residual.setZero();
  if (demand.tangent) out.k.setZero();
  if (demand.reference_tangent) out.k_x.setZero();
  SurfaceStress stress;
  for (int q = 0; q < QuadRule<N>::points; ++q) {
    const Eigen::Matrix<double, 2, N>& g = rule.gradients[q];
    const Eigen::Matrix<double, 3, 2> t_ref = in.reference * g.transpose();
    const Eigen::Matrix<double, 3, 2> t_def = in.deformed * g.transpose();
    if (!surface_stress(*in.law, in.skin, t_ref.transpose() * t_ref, t_def.transpose() * t_def,
                        stress))
      return;
    const double w = in.volume[q];
    Mat2 s;
    s << stress.s[0], stress.s[2], stress.s[2], stress.s[1];
    out.energy += w * stress.energy;
    out.residual.noalias() += (w * t_def * s) * g;
    if (!demand.tangent && !demand.reference_tangent) continue;
    const Eigen::Matrix<double, 3, 3 * N> rows = metric_rows<N>(t_def, g);
    if (demand.tangent) {
      out.k.noalias() += rows.transpose() * (w * stress.tangent * rows);
      const Eigen::Matrix<double, N, N> geometric = w * (g.transpose() * s * g);
      for (int b = 0; b < N; ++b) {
        for (int a = 0; a < N; ++a) {
          for (int i = 0; i < 3; ++i) out.k(3 * a + i, 3 * b + i) += geometric(a, b);
        }
      }
    }
    if (demand.reference_tangent) {
      out.k_x.noalias() +=
          rows.transpose() * (w * stress.reference_tangent * metric_rows<N>(t_ref, g));
    }
  }
  out.valid = std::isfinite(out.energy) && out.residual.allFinite();
}

template <int N>
Vec2 membrane_resultants(const MembraneInput<N>& in) {
  const Eigen::Matrix2Xd g = quad_shape(N == 4 ? 1 : 2, Vec2::Zero()).gradients;
  const Eigen::Matrix<double, 3, 2> t_ref = in.reference * g.transpose(),
                                    t_def = in.deformed * g.transpose();
  const Mat2 reference = t_ref.transpose() * t_ref, deformed = t_def.transpose() * t_def;
  SurfaceStress stress;
  if (!surface_stress(*in.law, in.skin, reference, deformed, stress))
    return Vec2::Constant(std::nan(""));
  Mat2 s;
  s << stress.s[0], stress.s[2], stress.s[2], stress.s[1];
  // Skin volume per parametric area over the deformed area turns S into force per length; the
  // principal values of S^{αβ} are those of S·a.
  const double per_length = in.volume.sum() / 4 / std::sqrt(deformed.determinant());
  const Mat2 mixed = per_length * s * deformed;
  const double mean = 0.5 * mixed.trace();
  const double spread = std::sqrt(std::max(0.0, mean * mean - mixed.determinant()));
  return {mean - spread, mean + spread};
}

template struct QuadRule<4>;
template Vec2 membrane_resultants<4>(const MembraneInput<4>&);
template Vec2 membrane_resultants<9>(const MembraneInput<9>&);
template struct QuadRule<9>;
template void membrane_kernel<4>(const MembraneInput<4>&, const HexDemand&, MembraneOutput<4>&);
template void membrane_kernel<9>(const MembraneInput<9>&, const HexDemand&, MembraneOutput<9>&);

}  // namespace breast
