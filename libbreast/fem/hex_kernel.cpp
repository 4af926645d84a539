// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/hex_kernel.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "fem/stress.hpp"
#include "fem/voigt.hpp"
#include "mesh/gauss.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

// Kinematics at one Gauss point. Gradients are N × 3, with respect to X.
template <int N>
struct Point {
  double det_reference, det_deformed, det_f;
  Eigen::Matrix<double, N, 3> gradient, spatial;
  Mat3 f, c;
};

template <int N>
bool kinematics(const Eigen::Matrix<double, 3, N>& reference,
                const Eigen::Matrix<double, 3, N>& deformed,
                const Eigen::Matrix<double, 3, N>& shape, Point<N>& point) {
  const Mat3 dx_ref = reference * shape.transpose(), dx_def = deformed * shape.transpose();
  point.det_reference = dx_ref.determinant();
  point.det_deformed = dx_def.determinant();
  if (!(point.det_reference > 0) || !(point.det_deformed > 0)) return false;
  point.det_f = point.det_deformed / point.det_reference;
  const Mat3 inverse = dx_ref.inverse();
  point.gradient.noalias() = shape.transpose() * inverse;
  point.spatial.noalias() = shape.transpose() * dx_def.inverse();
  point.f.noalias() = dx_def * inverse;
  point.c.noalias() = point.f.transpose() * point.f;
  return std::isfinite(point.det_f);
}

// Rows of δE = sym(Mᵀ ∇δ) in Voigt form for M = F (spatial variation) or M =
// −C (reference variation).
template <int N, class Block>
void strain_rows(const Mat3& m, const Eigen::Matrix<double, N, 3>& gradient, Block&& rows) {
  for (int b = 0; b < N; ++b) {
    for (int i = 0; i < 3; ++i) {
      for (int r = 0; r < 6; ++r) {
        const int j = voigt_row[r], k = voigt_column[r];
        rows(r, 3 * b + i) =
            r < 3 ? m(i, j) * gradient(b, j) : m(i, j) * gradient(b, k) + m(i, k) * gradient(b, j);
      }
    }
  }
}

// The parts of ∂r/∂X other than strain: the change of F, of ∇N and of the volume with X.
template <int N>
void add_reference_geometry(const Point<N>& point, const Mat3& s, double weight,
                            Eigen::Matrix<double, 3 * N, 3 * N>& k_x) {
  const Eigen::Matrix<double, N, 3>& g = point.gradient;
  const Eigen::Matrix<double, N, N> along = weight * (g * s * g.transpose());
  const Eigen::Matrix<double, 3, N> traction = weight * (point.f * s * g.transpose());
  for (int b = 0; b < N; ++b) {
    for (int a = 0; a < N; ++a) {
      auto block = k_x.template block<3, 3>(3 * a, 3 * b);
      block.noalias() -= along(a, b) * point.f;
      block.noalias() -= traction.col(b) * g.row(a);
      block.noalias() += traction.col(a) * g.row(b);
    }
  }
}

}  // namespace

template <int N>
const HexRule<N>& HexRule<N>::get() {
  static const HexRule rule = [] {
    HexRule made;
    const std::vector<GaussCubePoint> gauss = gauss_cube(N == 8 ? 2 : 3);
    for (int q = 0; q < points; ++q) {
      made.local[q] = gauss[q].at;
      made.weight[q] = gauss[q].weight;
      const HexShape shape = hex_shape(N == 8 ? 1 : 2, made.local[q]);
      made.values[q] = shape.values;
      made.gradients[q] = shape.gradients;
    }
    return made;
  }();
  return rule;
}

template <int N, int P>
void hex_kernel(const HexInput<N, P>& in, const HexDemand& demand, HexOutput<N, P>& out) {
  constexpr int Q = HexRule<N>::points;
  const HexRule<N>& rule = HexRule<N>::get();
  out.valid = false;
  out.energy = out.volume = out.reference_volume = out.gradient_square = 0;
  out.min_det = std::numeric_limits<double>::infinity();
  out.max_det = 0;
  out.residual.setZero();
  out.theta.setZero();
  out.b.setZero();
  const bool any_tangent = demand.tangent || demand.reference_tangent;
  if (demand.reference_tangent) {
    out.k_x.setZero();
    out.b_x.setZero();
  }
  // The strain rows of all Gauss points are stacked, so that K becomes one dense product.
  thread_local Eigen::Matrix<double, 6 * Q, 3 * N> rows, stiff, reference_rows;
  Eigen::Matrix<double, N, N> geometric = Eigen::Matrix<double, N, N>::Zero();
  Point<N> point;
  Stress stress;
  for (int q = 0; q < Q; ++q) {
    if (!kinematics<N>(in.reference, in.deformed, rule.gradients[q], point)) return;
    if (!law_stress(*in.law, in.isochoric, point.c, point.det_f, any_tangent, stress)) return;
    const auto psi = in.basis.col(q);
    add_pressure(psi.dot(in.pressure), point.c, point.det_f, any_tangent, stress);
    const double w = rule.weight[q], volume = w * point.det_reference;
    const Mat3 s = from_voigt(stress.s);
    out.min_det = std::min(out.min_det, point.det_f);
    out.max_det = std::max(out.max_det, point.det_f);
    out.volume += w * point.det_deformed;
    out.reference_volume += volume;
    out.energy += volume * stress.energy;
    out.residual.noalias() += (volume * point.f * s) * point.gradient.transpose();
    out.theta += (w * (point.det_deformed - point.det_reference)) * psi;
    const Eigen::Matrix<double, 3, N> spatial = point.spatial.transpose();
    const Eigen::Map<const Eigen::Matrix<double, 1, 3 * N>> flat(spatial.data());
    out.b.noalias() += (w * point.det_deformed) * (psi * flat);
    if (!any_tangent) continue;
    out.gradient_square += w * point.det_deformed * point.spatial.squaredNorm();
    auto block = rows.template middleRows<6>(6 * q);
    strain_rows<N>(point.f, point.gradient, block);
    if (demand.tangent) {
      stiff.template middleRows<6>(6 * q).noalias() = (volume * stress.tangent) * block;
      geometric.noalias() += point.gradient * (volume * s) * point.gradient.transpose();
    }
    if (demand.reference_tangent) {
      Eigen::Matrix<double, 6, 3 * N> back;
      strain_rows<N>(-point.c, point.gradient, back);
      reference_rows.template middleRows<6>(6 * q).noalias() = (volume * stress.tangent) * back;
      add_reference_geometry<N>(point, s, volume, out.k_x);
      const Eigen::Matrix<double, 3, N> gradient = point.gradient.transpose();
      const Eigen::Map<const Eigen::Matrix<double, 1, 3 * N>> flat_x(gradient.data());
      out.b_x.noalias() -= volume * (psi * flat_x);
    }
  }
  if (demand.tangent) {
    out.k.noalias() = rows.transpose() * stiff;
    for (int b = 0; b < N; ++b) {
      for (int a = 0; a < N; ++a) {
        for (int i = 0; i < 3; ++i) out.k(3 * a + i, 3 * b + i) += geometric(a, b);
      }
    }
  }
  if (demand.reference_tangent) out.k_x.noalias() += rows.transpose() * reference_rows;
  out.valid = std::isfinite(out.energy) && out.residual.allFinite();
}

template struct HexRule<8>;
template struct HexRule<27>;
template void hex_kernel<8, 1>(const HexInput<8, 1>&, const HexDemand&, HexOutput<8, 1>&);
template void hex_kernel<27, 4>(const HexInput<27, 4>&, const HexDemand&, HexOutput<27, 4>&);

}  // namespace breast
