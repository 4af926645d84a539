#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/parallel.hpp"
#include "mechanics/assembly_impl.hpp"

namespace breast {

template <int N, int P, int F>
struct AssemblyOf<N, P, F>::Chunk {
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

constexpr double condensed_ratio = 1e4;  // of bulk to shear modulus

// κ/μ: for a factor far above the material and far below what rounding forbids; for multigrid
// cycles, which degrade with it, just enough to keep the matrix positive definite where K is not
// and to help the pressure (1, 3, 10: 19, 16, 30 iterations on the block of 24³).
constexpr double factor_augmentation = 1e3, cycle_augmentation = 3;

// The present stiffness: trace K = (10/3) μ Σ|∇N|² for a linear solid (the pressure term has no
// trace).
template <int N, int P, int F>
double AssemblyOf<N, P, F>::shear_of(int e, const HexOutput<N, P>& out) const {
  const double rest = laws_[law_of_[e]].shear_modulus();
  const double now = out.k.trace() / (10.0 / 3 * out.gradient_square);
  return now > rest ? now : rest;
}

// κ proportional to the present stiffness. With a finite bulk modulus κ/K must be one number, so μ
// at rest is taken; up to condensed_ratio it is the bulk modulus itself, which makes the matrix the
// exact tangent without pressures: strong compression stiffens the laws far beyond μ at rest.
template <int N, int P, int F>
double AssemblyOf<N, P, F>::kappa_of(int e, double augmentation, double shear) const {
  if (!(bulk_ratio_ > 0)) return augmentation * shear;
  const double most = solver_ == LinearSolver::direct ? condensed_ratio : augmentation;
  return std::min(std::max(augmentation, most), bulk_ratio_) * laws_[law_of_[e]].shear_modulus();
}

template <int N, int P, int F>
bool AssemblyOf<N, P, F>::element(int e, const Eigen::VectorXd& reference, const SaddleState& state,
                                  const AssemblyRequest& request, HexOutput<N, P>& out) const {
  HexInput<N, P> in;
  in.reference = gather<N>(cells_, e, reference);
  in.deformed = gather<N>(cells_, e, state.u);
  in.pressure = state.p.segment<P>(long(P) * e);
  in.basis = basis_[e];
  in.law = &laws_[law_of_[e]];
  in.isochoric = isochoric_;
  hex_kernel<N, P>(in, {request.matrix != nullptr, request.reference != nullptr}, out);
  return out.valid;
}

template <int N, int P, int F>
void AssemblyOf<N, P, F>::store(int e, int at, const SaddleState& state,
                                const AssemblyRequest& request, HexOutput<N, P>& out,
                                SaddleForces& forces, Chunk& chunk) const {
  using Flat = Eigen::Map<Eigen::Matrix<double, 3 * N, 1>>;
  const Flat residual(out.residual.data());
  Flat(chunk.residuals.data() + at * 3 * N) = residual;
  // Finite bulk modulus: −∂Π/∂p = θ + c M p, p counted from rest.
  if (bulk_ratio_ > 0) {
    const Eigen::Matrix<double, P, 1> p =
        state.p.segment<P>(long(P) * e) - rest_pressure_.segment<P>(long(P) * e);
    out.theta += space_->compliance[e] * (space_->mass_at(e) * p);
  }
  forces.theta.segment<P>(long(P) * e) = out.theta;
  chunk.min_det[at] = out.min_det;
  chunk.max_det[at] = out.max_det;
  chunk.energy[at] = out.energy;
  chunk.volume_error[at] = std::abs(out.volume / out.reference_volume - 1);
  const Eigen::Matrix<double, P, P> inverse = space_->inverse_at(e);
  if (request.kappa != nullptr) {
    Flat(chunk.augmented.data() + at * 3 * N) =
        residual + out.b.transpose() * ((*request.kappa)[e] * (inverse * out.theta));
  }
  if (request.matrix != nullptr) {
    SaddleMatrix& matrix = *request.matrix;
    const double own = solver_ == LinearSolver::direct ? factor_augmentation : cycle_augmentation;
    const double shear = shear_of(e, out);
    const double kappa = kappa_of(e, request.augmentation > 0 ? request.augmentation : own, shear);
    matrix.kappa[e] = kappa;
    matrix.shear[e] = shear;
    matrix.divergence.at(e) = out.b;
    Flat(chunk.diagonals.data() + at * 3 * N) = out.k.diagonal();
    out.k.noalias() += out.b.transpose() * (kappa * inverse * out.b);
    std::copy_n(out.k.data(), K, chunk.matrices.data() + std::size_t(at) * K);
  }
  if (request.reference != nullptr) {
    request.reference->b_x.at(e) = out.b_x;
    request.reference->b.at(e) = out.b;
    std::copy_n(out.k_x.data(), K, request.reference->element_matrices.data() + std::size_t(e) * K);
  }
}

template <int N, int P, int F>
bool AssemblyOf<N, P, F>::elements_part(const Eigen::VectorXd& reference, const SaddleState& state,
                                        const AssemblyRequest& request,
                                        SaddleForces& forces) const {
  Chunk chunk(request.matrix != nullptr);
  for (int first = 0; first < cells_.count(); first += element_chunk) {
    const int count = std::min(element_chunk, cells_.count() - first);
    int bad = cells_.count();
#pragma omp parallel num_threads(threads()) reduction(min : bad)
    {
      const auto out = std::make_unique<HexOutput<N, P>>();
#pragma omp for schedule(dynamic, 16)
      for (int at = 0; at < count; ++at) {
        if (!element(first + at, reference, state, request, *out)) {
          bad = std::min(bad, first + at);
          continue;
        }
        store(first + at, at, state, request, *out, forces, chunk);
      }
    }
    if (bad < cells_.count()) {
      forces.bad_element = bad;
      return false;
    }
    for (int at = 0; at < count; ++at) {
      forces.min_det_F = std::min(forces.min_det_F, chunk.min_det[at]);
      forces.max_det_F = std::max(forces.max_det_F, chunk.max_det[at]);
      forces.max_volume_error = std::max(forces.max_volume_error, chunk.volume_error[at]);
      forces.energy += chunk.energy[at];
      for (int a = 0; a < 3 * N; ++a) {
        const long to = 3L * cells_.cell(first + at)[a / 3] + a % 3;
        forces.r[to] += chunk.residuals[at * 3 * N + a];
        if (request.kappa != nullptr) forces.augmented[to] += chunk.augmented[at * 3 * N + a];
        if (request.matrix != nullptr)
          request.matrix->diagonal[to] += chunk.diagonals[at * 3 * N + a];
      }
    }
    if (request.matrix != nullptr) {
      request.matrix->stiffness.add_cells(*element_map_, first, count, chunk.matrices.data());
    }
  }
  return true;
}

template <int N, int P, int F>
bool AssemblyOf<N, P, F>::faces_part(const Eigen::VectorXd& reference, const SaddleState& state,
                                     const AssemblyRequest& request, SaddleForces& forces) const {
  const int count = face_cells_.count();
  std::vector<double> matrices(request.matrix != nullptr ? std::size_t(count) * FK : 0);
  std::vector<double> residuals(std::size_t(count) * 3 * F), energies(count);
  int bad = cells_.count();
#pragma omp parallel for num_threads(threads()) schedule(static) reduction(min : bad)
  for (int f = 0; f < count; ++f) {
    MembraneInput<F> in;
    MembraneOutput<F> out;
    in.reference = gather<F>(face_cells_, f, reference);
    in.deformed = gather<F>(face_cells_, f, state.u);
    in.volume = skin_volume_[f];
    in.law = &laws_[std::size_t(Tissue::skin)];
    membrane_kernel<F>(in, {request.matrix != nullptr, request.reference != nullptr}, out);
    if (!out.valid) {
      bad = 0;
      continue;
    }
    energies[f] = out.energy;
    std::copy_n(out.residual.data(), 3 * F, residuals.data() + std::size_t(f) * 3 * F);
    if (request.matrix != nullptr) {
      std::copy_n(out.k.data(), FK, matrices.data() + std::size_t(f) * FK);
    }
    if (request.reference != nullptr) {
      std::copy_n(out.k_x.data(), FK,
                  request.reference->face_matrices.data() + std::size_t(f) * FK);
    }
  }
  if (bad < cells_.count()) return false;
  for (int f = 0; f < count; ++f) {
    forces.energy += energies[f];
    for (int a = 0; a < 3 * F; ++a) {
      const long to = 3L * face_cells_.cell(f)[a / 3] + a % 3;
      const double value = residuals[std::size_t(f) * 3 * F + a];
      forces.r[to] += value;
      if (request.kappa != nullptr) forces.augmented[to] += value;
      if (request.matrix != nullptr) {
        request.matrix->diagonal[to] += matrices[std::size_t(f) * FK + a * (3 * F + 1)];
      }
    }
  }
  if (request.matrix != nullptr) {
    request.matrix->stiffness.add_cells(*face_map_, 0, count, matrices.data());
  }
  return true;
}

template <int N, int P, int F>
SaddleForces AssemblyOf<N, P, F>::evaluate(const Eigen::VectorXd& reference,
                                           const SaddleState& state,
                                           const AssemblyRequest& request) const {
  SaddleForces forces;
  forces.element_count = cells_.count();
  forces.r = Eigen::VectorXd::Zero(3L * nodes());
  forces.theta = Eigen::VectorXd::Zero(long(P) * cells_.count());
  if (request.kappa != nullptr) forces.augmented = forces.r;
  forces.min_det_F = std::numeric_limits<double>::infinity();
  forces.max_det_F = 0;
  if (request.matrix != nullptr) {
    request.matrix->stiffness.set_zero();
    request.matrix->positions = state.u;
    request.matrix->diagonal.setZero();
  }
  if (request.reference != nullptr) {
    ReferenceTangent& tangent = *request.reference;
    tangent.elements = &cells_;
    tangent.faces = &face_cells_;
    tangent.element_matrices.resize(std::size_t(cells_.count()) * K);
    tangent.face_matrices.resize(std::size_t(face_cells_.count()) * FK);
    tangent.b_x.resize(cells_, P);
    tangent.b.resize(cells_, P);
  }
  if (!elements_part(reference, state, request, forces)) return forces;
  if (face_cells_.count() > 0 && !faces_part(reference, state, request, forces)) return forces;
  if (request.matrix != nullptr) {
    Eigen::VectorXd& diagonal = request.matrix->diagonal;
    const double floor = 1e-3 * diagonal.cwiseAbs().mean();
    diagonal = diagonal.cwiseMax(floor);
  }
  forces.valid = true;
  return forces;
}

template SaddleForces AssemblyOf<8, 1, 4>::evaluate(const Eigen::VectorXd&, const SaddleState&,
                                                    const AssemblyRequest&) const;
template SaddleForces AssemblyOf<27, 4, 9>::evaluate(const Eigen::VectorXd&, const SaddleState&,
                                                     const AssemblyRequest&) const;

}  // namespace breast
