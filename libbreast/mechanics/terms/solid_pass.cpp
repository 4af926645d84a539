// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/parallel.hpp"
#include "mechanics/terms/solid_impl.hpp"

namespace breast {

template <int N, int P>
struct SolidOf<N, P>::Chunk {
  std::vector<double> matrices;   // K + κBᵀM⁻¹B
  std::vector<double> diagonals;  // of K alone
  std::vector<double> residuals, augmented;
  std::vector<double> min_det, max_det, volume_error, energy;
  explicit Chunk(bool with_matrix)
      : matrices(with_matrix ? std::size_t(element_chunk) * K : 0),
        diagonals(with_matrix ? element_chunk * 3 * N : 0),
        residuals(element_chunk * 3 * N),
        augmented(element_chunk * 3 * N),
        min_det(element_chunk),
        max_det(element_chunk),
        volume_error(element_chunk),
        energy(element_chunk) {}
};

// Destination of the results of a pass: the request, and this term's own part of the data kept by
// cells.
template <int N, int P>
struct SolidOf<N, P>::Targets {
  const Request& request;
  CellMatrices* reference = nullptr;
  PackedCells* packed = nullptr;
};

constexpr double condensed_ratio = 1e4;  // of bulk to shear modulus

// κ/μ. For a Cholesky factor it is far above the material's and far below the limit set by
// rounding. For multigrid cycles, which degrade with it, it is just enough to keep the matrix
// positive definite where K is not and to help the pressure (1, 3, 10: 19, 16, 30 iterations on the
// block of 24³).
constexpr double factor_augmentation = 1e3, cycle_augmentation = 3;

// The present stiffness, from trace K = (10/3) μ Σ|∇N|² of a linear solid (the pressure term has no
// trace).
template <int N, int P>
double SolidOf<N, P>::shear_of(int e, const HexOutput<N, P>& out) const {
  const double rest = laws_[law_of_[e]].shear_modulus();
  const double now = out.k.trace() / (10.0 / 3 * out.gradient_square);
  return now > rest ? now : rest;
}

// κ is proportional to the present stiffness. With a finite bulk modulus κ/K must be a single
// number, so μ at rest is used. A factor then uses the bulk modulus itself as κ, up to
// condensed_ratio, which makes the matrix the exact tangent without pressures: strong compression
// stiffens the laws far beyond μ at rest. A κ/μ given explicitly is used as it is, but never above
// the bulk modulus.
template <int N, int P>
double SolidOf<N, P>::kappa_of(int e, const Request& request, double shear) const {
  const bool direct = solver_ == LinearSolver::direct;
  const double asked = request.augmentation;
  if (!(bulk_ratio_ > 0)) {
    return (asked > 0 ? asked : direct ? factor_augmentation : cycle_augmentation) * shear;
  }
  const double wanted = asked > 0 ? asked : direct ? condensed_ratio : cycle_augmentation;
  return std::min(wanted, bulk_ratio_) * laws_[law_of_[e]].shear_modulus();
}

template <int N, int P>
bool SolidOf<N, P>::element(int e, const State& state, const Request& request,
                            HexOutput<N, P>& out) const {
  HexInput<N, P> in;
  in.reference = gather<N>(cells().cell(e), state.reference);
  in.deformed = gather<N>(cells().cell(e), state.x);
  in.pressure = state.p.segment<P>(long(P) * e);
  in.basis = basis_[e];
  in.law = &laws_[law_of_[e]];
  in.isochoric = isochoric_;
  const bool tangent = request.matrix != nullptr || request.packed != nullptr;
  hex_kernel<N, P>(in, {tangent, request.reference != nullptr}, out);
  return out.valid;
}

template <int N, int P>
void SolidOf<N, P>::store(int e, int at, const State& state, const Targets& targets,
                          HexOutput<N, P>& out, Forces& forces, Chunk& chunk) const {
  using Flat = Eigen::Map<Eigen::Matrix<double, 3 * N, 1>>;
  const Flat residual(out.residual.data());
  Flat(chunk.residuals.data() + at * 3 * N) = residual;
  // With a finite bulk modulus, −∂Π/∂p = θ + c M p, where p is relative to the pressure at rest.
  if (bulk_ratio_ > 0) {
    const Eigen::Matrix<double, P, 1> p =
        state.p.segment<P>(long(P) * e) - rest_pressure_.segment<P>(long(P) * e);
    const Eigen::Matrix<double, P, 1> mp = pressures().mass_at(e) * p;
    out.energy -= 0.5 * pressures().compliance[e] * p.dot(mp);
    out.theta += pressures().compliance[e] * mp;
  }
  forces.theta.segment<P>(long(P) * e) = out.theta;
  chunk.min_det[at] = out.min_det;
  chunk.max_det[at] = out.max_det;
  chunk.energy[at] = out.energy;
  chunk.volume_error[at] = std::abs(out.volume / out.reference_volume - 1);
  const Request& request = targets.request;
  if (request.kappa != nullptr) {
    Flat(chunk.augmented.data() + at * 3 * N) =
        residual +
        out.b.transpose() * ((*request.kappa)[e] * (pressures().inverse_at(e) * out.theta));
  }
  if (request.reference != nullptr) {
    request.reference->b_x.at(e) = out.b_x;
    request.reference->b.at(e) = out.b;
    std::copy_n(out.k_x.data(), K, targets.reference->at(e));
  }
  if (request.matrix != nullptr || request.packed != nullptr) {
    const double kappa = store_tangent(e, at, targets, out, chunk);
    if (request.packed != nullptr) request.packed->kappa[e] = kappa;
  }
}

// K + κBᵀM⁻¹B of one element; returns κ.
template <int N, int P>
double SolidOf<N, P>::store_tangent(int e, int at, const Targets& targets, HexOutput<N, P>& out,
                                    Chunk& chunk) const {
  const double shear = shear_of(e, out), kappa = kappa_of(e, targets.request, shear);
  const Eigen::Matrix<double, P, P> inverse = pressures().inverse_at(e);
  if (targets.request.matrix != nullptr) {
    SaddleMatrix& matrix = *targets.request.matrix;
    matrix.kappa[e] = kappa;
    matrix.shear[e] = shear;
    matrix.divergence.at(e) = out.b;
    Eigen::Map<Eigen::Matrix<double, 3 * N, 1>>(chunk.diagonals.data() + at * 3 * N) =
        out.k.diagonal();
  }
  out.k.noalias() += out.b.transpose() * (kappa * inverse * out.b);
  if (targets.request.matrix != nullptr) {
    std::copy_n(out.k.data(), K, chunk.matrices.data() + std::size_t(at) * K);
  }
  if (targets.packed != nullptr) targets.packed->set(e, out.k.data());
  return kappa;
}

template <int N, int P>
void SolidOf<N, P>::add_chunk(int first, int count, const Request& request, const Chunk& chunk,
                              Forces& forces) const {
  for (int at = 0; at < count; ++at) {
    forces.min_det_F = std::min(forces.min_det_F, chunk.min_det[at]);
    forces.max_det_F = std::max(forces.max_det_F, chunk.max_det[at]);
    forces.max_volume_error = std::max(forces.max_volume_error, chunk.volume_error[at]);
    forces.energy += chunk.energy[at];
    for (int a = 0; a < 3 * N; ++a) {
      const long to = 3L * cells().cell(first + at)[a / 3] + a % 3;
      forces.r[to] += chunk.residuals[at * 3 * N + a];
      if (request.kappa != nullptr) forces.augmented[to] += chunk.augmented[at * 3 * N + a];
      if (request.matrix != nullptr) {
        request.matrix->diagonal[to] += chunk.diagonals[at * 3 * N + a];
      }
    }
  }
  if (request.matrix != nullptr) {
    request.matrix->stiffness.add_cells(*scatter_, first, count, chunk.matrices.data());
  }
}

template <int N, int P>
bool SolidOf<N, P>::add(const State& state, const Request& request, Forces& forces) const {
  Targets targets{request};
  if (request.reference != nullptr) targets.reference = &request.reference->next(cells());
  if (request.packed != nullptr) targets.packed = &request.packed->next(cells());
  Chunk chunk(request.matrix != nullptr);
  for (int first = 0; first < cells().count(); first += element_chunk) {
    const int count = std::min(element_chunk, cells().count() - first);
    int bad = cells().count();
#pragma omp parallel num_threads(threads()) reduction(min : bad)
    {
      const auto out = std::make_unique<HexOutput<N, P>>();
#pragma omp for schedule(dynamic, 16)
      for (int at = 0; at < count; ++at) {
        if (!element(first + at, state, request, *out)) {
          bad = std::min(bad, first + at);
          continue;
        }
        store(first + at, at, state, targets, *out, forces, chunk);
      }
    }
    if (bad < cells().count()) {
      forces.bad_element = bad;
      return false;
    }
    add_chunk(first, count, request, chunk, forces);
  }
  return true;
}

template bool SolidOf<8, 1>::add(const State&, const Request&, Forces&) const;
template bool SolidOf<27, 4>::add(const State&, const Request&, Forces&) const;

}  // namespace breast
