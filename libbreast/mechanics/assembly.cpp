#include "mechanics/assembly.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fem/hex_kernel.hpp"
#include "fem/membrane_kernel.hpp"

namespace breast {

namespace {

template <int N>
Eigen::Matrix<double, 3, N> gather(const Cells& cells, int c, const Eigen::VectorXd& nodal) {
  Eigen::Matrix<double, 3, N> out;
  for (int a = 0; a < N; ++a) out.col(a) = nodal.segment<3>(3L * cells.cell(c)[a]);
  return out;
}

// Elements of kind (N nodes, P pressures), skin faces of F nodes.
template <int N, int P, int F>
class AssemblyOf final : public Assembly {
 public:
  AssemblyOf(const HexMesh& mesh, const MechanicsOptions& options);
  SaddleForces evaluate(const Eigen::VectorXd& reference, const SaddleState& state,
                        const AssemblyRequest& request) const override;
  std::vector<double> mean_pressure(const Eigen::VectorXd& p) const override;
  std::vector<double> mean_det_f(const Eigen::VectorXd& reference,
                                 const Eigen::VectorXd& deformed) const override;

 private:
  static constexpr int K = 9 * N * N, FK = 9 * F * F;
  static constexpr int element_chunk = N == 8 ? 4096 : 256;
  using Basis = Eigen::Matrix<double, P, HexRule<N>::points>;
  struct Chunk;

  void set_imaged(const HexMesh& mesh, const MechanicsOptions& options);
  void set_skin(const HexMesh& mesh, const MechanicsOptions& options);
  bool element(int e, const Eigen::VectorXd& reference, const SaddleState& state,
               const AssemblyRequest& request, HexOutput<N, P>& out) const;
  void store(int e, int at, const SaddleState& state, const AssemblyRequest& request,
             HexOutput<N, P>& out, SaddleForces& forces, Chunk& chunk) const;
  bool elements_part(const Eigen::VectorXd& reference, const SaddleState& state,
                     const AssemblyRequest& request, SaddleForces& forces) const;
  bool faces_part(const Eigen::VectorXd& reference, const SaddleState& state,
                  const AssemblyRequest& request, SaddleForces& forces) const;
  double kappa_of(int e, double augmentation, const HexOutput<N, P>& out) const;

  bool isochoric_;
  double bulk_ratio_;
  std::vector<Law> laws_;  // by tissue
  std::vector<int> law_of_;
  std::vector<Basis, Eigen::aligned_allocator<Basis>> basis_;
  std::vector<Eigen::Matrix<double, QuadRule<F>::points, 1>,
              Eigen::aligned_allocator<Eigen::Matrix<double, QuadRule<F>::points, 1>>>
      skin_volume_;
};

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

template <int N, int P, int F>
AssemblyOf<N, P, F>::AssemblyOf(const HexMesh& mesh, const MechanicsOptions& options)
    : isochoric_(options.invariants == Invariants::isochoric), bulk_ratio_(options.bulk_ratio) {
  cells_.nodes_per_cell = N;
  cells_.nodes = mesh.connectivity;
  pattern_ = std::make_shared<NodePattern>(mesh.nodes(), cells_);
  element_map_ = std::make_shared<ScatterMap>(*pattern_, cells_);
  laws_.assign(options.materials.laws.begin(), options.materials.laws.end());
  for (const Tissue tissue : mesh.tissue) law_of_.push_back(int(tissue));
  set_imaged(mesh, options);
  if (mesh.skin_model == SkinModel::membrane) set_skin(mesh, options);
}

// Everything that belongs to the imaged shape: volumes, masses, pressure basis and its mass matrix.
template <int N, int P, int F>
void AssemblyOf<N, P, F>::set_imaged(const HexMesh& mesh, const MechanicsOptions& options) {
  const HexRule<N>& rule = HexRule<N>::get();
  const Eigen::VectorXd imaged = flatten(mesh.imaged);
  auto space = std::make_shared<PressureSpace>();
  const int count = cells_.count();
  space->rows = P;
  space->compliance = Eigen::VectorXd::Zero(count);
  nodal_mass_ = Eigen::VectorXd::Zero(mesh.nodes());
  rest_pressure_ = Eigen::VectorXd::Zero(long(P) * count);
  basis_.resize(static_cast<std::size_t>(count));
  for (int e = 0; e < count; ++e) {
    const Eigen::Matrix<double, 3, N> x = gather<N>(cells_, e, imaged);
    Eigen::Matrix<double, 1, HexRule<N>::points> volume;
    for (int q = 0; q < HexRule<N>::points; ++q) {
      const Mat3 jacobian = x * rule.gradients[q].transpose();
      volume[q] = rule.weight[q] * jacobian.determinant();
      if (!(volume[q] > 0)) {
        const Vec3 where = x.rowwise().mean();
        throw input_error("mesh: element ", e, " of the imaged shape is folded near (", where.x(),
                          ", ", where.y(), ", ", where.z(), ") mm; remesh with hexmesh");
      }
    }
    const double total = volume.sum(), size = std::cbrt(total);
    const Vec3 centre = x.rowwise().mean();
    Basis& psi = basis_[e];
    for (int q = 0; q < HexRule<N>::points; ++q) {
      psi(0, q) = 1;
      if constexpr (P == 4) psi.col(q).template tail<3>() = (x * rule.values[q] - centre) / size;
    }
    const Eigen::Matrix<double, P, P> m = psi * volume.asDiagonal() * psi.transpose();
    const Eigen::Matrix<double, P, P> inverse = m.inverse();
    space->mass.insert(space->mass.end(), m.data(), m.data() + P * P);
    space->inverse_mass.insert(space->inverse_mass.end(), inverse.data(), inverse.data() + P * P);
    imaged_volume_.push_back(total);
    const Law& law = laws_[law_of_[e]];
    if (bulk_ratio_ > 0) space->compliance[e] = 1 / (bulk_ratio_ * law.shear_modulus());
    const double density = options.materials.density[law_of_[e]];
    for (int a = 0; a < N; ++a) {
      double mass = 0;
      for (int q = 0; q < HexRule<N>::points; ++q) mass += volume[q] * rule.values[q][a];
      nodal_mass_[cells_.cell(e)[a]] += density * mass;
    }
    if (!isochoric_) {
      const LawValue rest = law.evaluate(3, 3);
      rest_pressure_[long(P) * e] = 2 * rest.w1 + 4 * rest.w2;
    }
  }
  space_ = space;
}

template <int N, int P, int F>
void AssemblyOf<N, P, F>::set_skin(const HexMesh& mesh, const MechanicsOptions&) {
  if (mesh.skin_thickness.size() != mesh.skin_faces.size()) {
    throw input_error("mesh: membrane skin needs one thickness per skin face: ",
                      mesh.skin_thickness.size(), " given for ", mesh.skin_faces.size(), " faces");
  }
  const QuadRule<F>& rule = QuadRule<F>::get();
  const Eigen::VectorXd imaged = flatten(mesh.imaged);
  face_cells_.nodes_per_cell = F;
  for (std::size_t f = 0; f < mesh.skin_faces.size(); ++f) {
    const std::vector<int> nodes = face_nodes(mesh, mesh.skin_faces[f]);
    face_cells_.nodes.insert(face_cells_.nodes.end(), nodes.begin(), nodes.end());
    const Eigen::Matrix<double, 3, F> x = gather<F>(face_cells_, int(f), imaged);
    Eigen::Matrix<double, QuadRule<F>::points, 1> volume;
    for (int q = 0; q < QuadRule<F>::points; ++q) {
      const Eigen::Matrix<double, 3, 2> t = x * rule.gradients[q].transpose();
      volume[q] =
          mesh.skin_thickness[f] * rule.weight[q] * std::sqrt((t.transpose() * t).determinant());
    }
    skin_volume_.push_back(volume);
  }
  face_map_ = std::make_shared<ScatterMap>(*pattern_, face_cells_);
}

// κ proportional to the present stiffness: trace K = (10/3) μ Σ|∇N|² for a linear solid (the
// pressure term has no trace). With a finite bulk modulus κ/K must be one number, so μ at rest is
// taken.
template <int N, int P, int F>
double AssemblyOf<N, P, F>::kappa_of(int e, double augmentation, const HexOutput<N, P>& out) const {
  const double rest = laws_[law_of_[e]].shear_modulus();
  if (bulk_ratio_ > 0) return std::min(augmentation, bulk_ratio_) * rest;
  const double now = out.k.trace() / (10.0 / 3 * out.gradient_square);
  return augmentation * (now > rest ? now : rest);
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
    const double kappa = kappa_of(e, request.augmentation, out);
    matrix.kappa[e] = kappa;
    matrix.divergence.at(e) = out.b;
    Flat(chunk.diagonals.data() + at * 3 * N) = out.k.diagonal();
    out.k.noalias() += out.b.transpose() * (kappa * inverse * out.b);
    std::copy_n(out.k.data(), K, chunk.matrices.data() + std::size_t(at) * K);
  }
  if (request.reference != nullptr) {
    request.reference->b_x.at(e) = out.b_x;
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
    request.matrix->diagonal.setZero();
  }
  if (request.reference != nullptr) {
    ReferenceTangent& tangent = *request.reference;
    tangent.elements = &cells_;
    tangent.faces = &face_cells_;
    tangent.element_matrices.resize(std::size_t(cells_.count()) * K);
    tangent.face_matrices.resize(std::size_t(face_cells_.count()) * FK);
    tangent.b_x.resize(cells_, P);
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

template <int N, int P, int F>
std::vector<double> AssemblyOf<N, P, F>::mean_pressure(const Eigen::VectorXd& p) const {
  std::vector<double> mean;
  for (int e = 0; e < cells_.count(); ++e) {
    // ∫p dV over V: the first row of M integrates.
    mean.push_back(space_->mass_at(e).row(0).dot(p.segment<P>(long(P) * e)) / imaged_volume_[e]);
  }
  return mean;
}

template <int N, int P, int F>
std::vector<double> AssemblyOf<N, P, F>::mean_det_f(const Eigen::VectorXd& reference,
                                                    const Eigen::VectorXd& deformed) const {
  const HexRule<N>& rule = HexRule<N>::get();
  std::vector<double> mean;
  for (int e = 0; e < cells_.count(); ++e) {
    double before = 0, after = 0;
    for (int q = 0; q < HexRule<N>::points; ++q) {
      const Mat3 from = gather<N>(cells_, e, reference) * rule.gradients[q].transpose();
      const Mat3 to = gather<N>(cells_, e, deformed) * rule.gradients[q].transpose();
      before += rule.weight[q] * from.determinant();
      after += rule.weight[q] * to.determinant();
    }
    mean.push_back(after / before);
  }
  return mean;
}

}  // namespace

SaddleMatrix Assembly::make_matrix() const {
  SaddleMatrix matrix{NodeMatrix(pattern_), {}, {}, {}, space_};
  matrix.divergence.resize(cells_, space_->rows);
  matrix.kappa = Eigen::VectorXd::Zero(cells_.count());
  matrix.diagonal = Eigen::VectorXd::Zero(pattern_->unknowns());
  return matrix;
}

std::unique_ptr<Assembly> make_assembly(const HexMesh& mesh, const MechanicsOptions& options) {
  if (options.element == Element::q1p0) {
    if (mesh.order != 1) {
      throw input_error(
          "element q1p0 needs a mesh of 8-node elements, this one has 27: use --element q2p1");
    }
    return std::make_unique<AssemblyOf<8, 1, 4>>(mesh, options);
  }
  if (mesh.order != 2) {
    throw failed_error("element q2p1 needs a mesh of 27-node elements: raise its order first");
  }
  return std::make_unique<AssemblyOf<27, 4, 9>>(mesh, options);
}

Eigen::VectorXd flatten(const std::vector<Vec3>& nodal) {
  Eigen::VectorXd flat(3L * long(nodal.size()));
  for (std::size_t i = 0; i < nodal.size(); ++i) flat.segment<3>(3L * long(i)) = nodal[i];
  return flat;
}

std::vector<Vec3> unflatten(const Eigen::VectorXd& flat) {
  std::vector<Vec3> nodal(static_cast<std::size_t>(flat.size() / 3));
  for (std::size_t i = 0; i < nodal.size(); ++i) nodal[i] = flat.segment<3>(3L * long(i));
  return nodal;
}

}  // namespace breast
