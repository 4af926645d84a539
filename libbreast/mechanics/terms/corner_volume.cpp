// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/corner_volume.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.hpp"
#include "fem/gather.hpp"
#include "mesh/shape.hpp"
#include "solve/cell_results.hpp"

namespace breast {

namespace {

/// `N`: nodes of an element, 8 or 27.
template <int N>
class CornerVolume final : public Term {
 public:
  CornerVolume(std::vector<double> bulk, const Discretisation& space);
  std::string name() const override { return "corner volume"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override { return nodes_of_cells(cells_); }

 private:
  using Column = Eigen::Matrix<double, 3 * N, 1>;
  using Square = Eigen::Matrix<double, 3 * N, 3 * N>;
  static constexpr int K = 9 * N * N;
  // An element's nodes share its volume equally; the reference element has a volume of 8.
  static constexpr double share = 8.0 / N;
  bool element(int e, const State& state, CellMatrices* reference, CellResults& results) const;

  std::vector<double> bulk_;  // per element, Pa
  Cells cells_;
  std::shared_ptr<const ScatterMap> scatter_;
  std::array<Eigen::Matrix<double, 3, N>, N> gradients_;  // ∂N/∂ξ at the nodes
};

template <int N>
CornerVolume<N>::CornerVolume(std::vector<double> bulk, const Discretisation& space)
    : bulk_(std::move(bulk)), cells_(space.cells) {
  constexpr int order = N == 8 ? 1 : 2;
  for (int a = 0; a < N; ++a)
    gradients_[std::size_t(a)] = hex_shape(order, hex_node_local(order, a)).gradients;
  if (space.pattern) scatter_ = std::make_shared<ScatterMap>(*space.pattern, cells_);
}

template <int N>
bool CornerVolume<N>::element(int e, const State& state, CellMatrices* reference,
                              CellResults& results) const {
  const Eigen::Matrix<double, 3, N> before = gather<N>(cells_.cell(e), state.reference);
  const Eigen::Matrix<double, 3, N> after = gather<N>(cells_.cell(e), state.x);
  const bool tangent = results.with_tangent();
  Square k = Square::Zero(), k_x = Square::Zero();
  Column residual = Column::Zero();
  double energy = 0;
  for (const Eigen::Matrix<double, 3, N>& shape : gradients_) {
    const Mat3 from = before * shape.transpose(), to = after * shape.transpose();
    const double volume = from.determinant(), now = to.determinant();
    if (!(volume > 0) || !(now > 0)) return false;
    const double stiffness = share * bulk_[std::size_t(e)] * volume;
    const double strain = std::log(now / volume);
    const double square = strain * strain;
    // ∂ ln det(∂x/∂ξ)/∂x, component by component.
    const Eigen::Matrix<double, 3, N> rate = to.inverse().transpose() * shape;
    const Eigen::Map<const Column> flat(rate.data());
    energy += 0.25 * stiffness * square * square;
    residual += stiffness * square * strain * flat;
    if (tangent) {
      k.noalias() += 3 * stiffness * square * flat * flat.transpose();
      for (int b = 0; b < N; ++b) {
        for (int a = 0; a < N; ++a)
          k.template block<3, 3>(3 * a, 3 * b).noalias() -=
              stiffness * square * strain * rate.col(b) * rate.col(a).transpose();
      }
    }
    if (reference != nullptr) {
      const Eigen::Matrix<double, 3, N> at_rest = from.inverse().transpose() * shape;
      const Eigen::Map<const Column> flat_x(at_rest.data());
      k_x.noalias() += stiffness * square * (strain - 3) * flat * flat_x.transpose();
    }
  }
  results.energies[std::size_t(e)] = energy;
  std::copy_n(residual.data(), 3 * N, results.residual(e));
  if (tangent) std::copy_n(k.data(), K, results.matrix(e));
  if (reference != nullptr) std::copy_n(k_x.data(), K, reference->at(e));
  return true;
}

template <int N>
bool CornerVolume<N>::add(const State& state, const Request& request, Forces& forces) const {
  const int count = cells_.count();
  CellMatrices* reference =
      request.reference != nullptr ? &request.reference->next(cells_) : nullptr;
  CellResults results(cells_, request);
  int bad = count;
#pragma omp parallel for num_threads(threads()) schedule(static) reduction(min : bad)
  for (int e = 0; e < count; ++e)
    if (!element(e, state, reference, results)) bad = std::min(bad, e);
  if (bad < count) {
    forces.bad_element = bad;
    return false;
  }
  results.add_to(request, scatter_.get(), forces);
  return true;
}

}  // namespace

std::shared_ptr<const Term> make_corner_volume(const HexMesh& mesh, const MechanicsOptions& options,
                                               const Discretisation& space, double factor) {
  std::vector<double> bulk;
  for (const Tissue tissue : mesh.tissue)
    bulk.push_back(factor * options.materials.corner_bulk[std::size_t(tissue)]);
  if (std::all_of(bulk.begin(), bulk.end(), [](double k) { return k == 0; })) return nullptr;
  if (mesh.order == 1) return std::make_shared<CornerVolume<8>>(std::move(bulk), space);
  return std::make_shared<CornerVolume<27>>(std::move(bulk), space);
}

}  // namespace breast
