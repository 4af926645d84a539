// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/solid.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "mechanics/terms/solid_impl.hpp"
#include "mesh/shape.hpp"

namespace breast {

// The pass is compiled in solid_pass.cpp.
extern template bool SolidOf<8, 1>::add(const State&, const Request&, Forces&) const;
extern template bool SolidOf<27, 4>::add(const State&, const Request&, Forces&) const;

template <int N, int P>
SolidOf<N, P>::SolidOf(const HexMesh& mesh, const MechanicsOptions& options, TangentStorage storage)
    : isochoric_(options.invariants == Invariants::isochoric), bulk_ratio_(options.bulk_ratio) {
  order_ = mesh.order;
  if (options.solver == SolverOption::multigrid) solver_ = LinearSolver::multigrid;
  laws_.assign(options.materials.laws.begin(), options.materials.laws.end());
  for (const Tissue tissue : mesh.tissue) law_of_.push_back(int(tissue));
  set_imaged(mesh, options, storage);
  if (space_->pattern) scatter_ = std::make_shared<ScatterMap>(*space_->pattern, cells());
}

// All data of the imaged shape: volumes, masses, pressure basis and its mass matrix.
template <int N, int P>
void SolidOf<N, P>::set_imaged(const HexMesh& mesh, const MechanicsOptions& options,
                               TangentStorage storage) {
  const HexRule<N>& rule = HexRule<N>::get();
  auto space = std::make_shared<Discretisation>();
  space->cells.nodes_per_cell = N;
  space->cells.nodes = mesh.connectivity;
  space->node_count = mesh.nodes();
  if (storage == TangentStorage::assembled) {
    space->pattern = std::make_shared<NodePattern>(mesh.nodes(), space->cells);
  }
  auto pressures = std::make_shared<PressureSpace>();
  const Eigen::VectorXd imaged = flatten(mesh.imaged);
  const int count = space->cells.count();
  pressures->rows = P;
  pressures->compliance = Eigen::VectorXd::Zero(count);
  nodal_mass_ = Eigen::VectorXd::Zero(mesh.nodes());
  rest_pressure_ = Eigen::VectorXd::Zero(long(P) * count);
  basis_.resize(static_cast<std::size_t>(count));
  for (int e = 0; e < count; ++e) {
    const int* nodes = space->cells.cell(e);
    const Eigen::Matrix<double, 3, N> x = gather<N>(nodes, imaged);
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
    const double size = std::cbrt(volume.sum());
    const Vec3 centre = x.rowwise().mean();
    Basis& psi = basis_[e];
    for (int q = 0; q < HexRule<N>::points; ++q) {
      psi(0, q) = 1;
      if constexpr (P == 4) psi.col(q).template tail<3>() = (x * rule.values[q] - centre) / size;
    }
    const Eigen::Matrix<double, P, P> m = psi * volume.asDiagonal() * psi.transpose();
    const Eigen::Matrix<double, P, P> inverse = m.inverse();
    pressures->mass.insert(pressures->mass.end(), m.data(), m.data() + P * P);
    pressures->inverse_mass.insert(pressures->inverse_mass.end(), inverse.data(),
                                   inverse.data() + P * P);
    const Law& law = laws_[law_of_[e]];
    if (bulk_ratio_ > 0) pressures->compliance[e] = 1 / (bulk_ratio_ * law.shear_modulus());
    const double density = options.materials.density[law_of_[e]];
    for (int a = 0; a < N; ++a) {
      double mass = 0;
      for (int q = 0; q < HexRule<N>::points; ++q) mass += volume[q] * rule.values[q][a];
      nodal_mass_[nodes[a]] += density * mass;
    }
    if (!isochoric_) {
      const LawValue rest = law.evaluate(3, 3);
      rest_pressure_[long(P) * e] = 2 * rest.w1 + 4 * rest.w2;
    }
  }
  space->pressures = pressures;
  space_ = space;
}

template <int N, int P>
std::vector<double> SolidOf<N, P>::mean_pressure(const Eigen::VectorXd& p) const {
  std::vector<double> mean;
  for (int e = 0; e < cells().count(); ++e) {
    // ∫p dV over V: the first row of M integrates.
    mean.push_back(pressures().mass_at(e).row(0).dot(p.segment<P>(long(P) * e)) /
                   pressures().volume(e));
  }
  return mean;
}

template <int N, int P>
std::vector<double> SolidOf<N, P>::mean_det_f(const Eigen::VectorXd& reference,
                                              const Eigen::VectorXd& deformed) const {
  const HexRule<N>& rule = HexRule<N>::get();
  std::vector<double> mean;
  for (int e = 0; e < cells().count(); ++e) {
    double before = 0, after = 0;
    for (int q = 0; q < HexRule<N>::points; ++q) {
      const Mat3 from = gather<N>(cells().cell(e), reference) * rule.gradients[q].transpose();
      const Mat3 to = gather<N>(cells().cell(e), deformed) * rule.gradients[q].transpose();
      before += rule.weight[q] * from.determinant();
      after += rule.weight[q] * to.determinant();
    }
    mean.push_back(after / before);
  }
  return mean;
}

namespace {

// Gradients of the shape functions at the nodes and quadrature points of an element.
std::vector<HexShape> places_to_check(int order) {
  std::vector<HexShape> places;
  for (int a = 0; a < (order == 1 ? 8 : 27); ++a)
    places.push_back(hex_shape(order, hex_node_local(order, a)));
  const auto add = [&](const auto& points) {
    for (const Vec3& local : points) places.push_back(hex_shape(order, local));
  };
  if (order == 1) {
    add(HexRule<8>::get().local);
  } else {
    add(HexRule<27>::get().local);
  }
  return places;
}

bool positive(const Cells& cells, int e, const Eigen::VectorXd& nodal,
              const std::vector<HexShape>& places) {
  for (const HexShape& place : places) {
    Mat3 jacobian = Mat3::Zero();
    for (int a = 0; a < cells.nodes_per_cell; ++a) {
      jacobian += nodal.segment<3>(3L * cells.cell(e)[a]) * place.gradients.col(a).transpose();
    }
    if (!(jacobian.determinant() > 0)) return false;
  }
  return true;
}

}  // namespace

int Solid::folded_element(const State& state) const {
  const std::vector<HexShape> places = places_to_check(order_);
  const Cells& cells = space_->cells;
  for (int e = 0; e < cells.count(); ++e) {
    if (!positive(cells, e, state.reference, places) || !positive(cells, e, state.x, places)) {
      return e;
    }
  }
  return -1;
}

std::vector<int> Solid::nodes() const {
  std::vector<int> all(std::size_t(space_->nodes()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::shared_ptr<const Solid> make_solid(const HexMesh& mesh, const MechanicsOptions& options,
                                        TangentStorage storage) {
  if (options.element == Element::q1p0) {
    if (mesh.order != 1) {
      throw input_error(
          "element q1p0 needs a mesh of 8-node elements, this one has 27: use --element q2p1");
    }
    return std::make_shared<SolidOf<8, 1>>(mesh, options, storage);
  }
  if (mesh.order != 2) {
    throw failed_error("element q2p1 needs a mesh of 27-node elements: raise its order first");
  }
  return std::make_shared<SolidOf<27, 4>>(mesh, options, storage);
}

}  // namespace breast
