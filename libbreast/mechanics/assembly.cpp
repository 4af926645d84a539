#include "mechanics/assembly.hpp"

#include <Eigen/LU>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/assembly_impl.hpp"

namespace breast {

// The pass is compiled in assembly_pass.cpp.
extern template SaddleForces AssemblyOf<8, 1, 4>::evaluate(const Eigen::VectorXd&,
                                                           const SaddleState&,
                                                           const AssemblyRequest&) const;
extern template SaddleForces AssemblyOf<27, 4, 9>::evaluate(const Eigen::VectorXd&,
                                                            const SaddleState&,
                                                            const AssemblyRequest&) const;

template <int N, int P, int F>
AssemblyOf<N, P, F>::AssemblyOf(const HexMesh& mesh, const MechanicsOptions& options)
    : isochoric_(options.invariants == Invariants::isochoric), bulk_ratio_(options.bulk_ratio) {
  cells_.nodes_per_cell = N;
  cells_.nodes = mesh.connectivity;
  pattern_ = std::make_shared<NodePattern>(mesh.nodes(), cells_);
  element_map_ = std::make_shared<ScatterMap>(*pattern_, cells_);
  if (options.solver == "multigrid") solver_ = LinearSolver::multigrid;
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

SaddleMatrix Assembly::make_matrix() const {
  SaddleMatrix matrix{NodeMatrix(pattern_), {}, {}, {}, {}, space_, {}};
  matrix.divergence.resize(cells_, space_->rows);
  matrix.kappa = matrix.shear = Eigen::VectorXd::Zero(cells_.count());
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
