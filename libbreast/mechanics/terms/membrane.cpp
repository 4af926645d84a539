// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/membrane.hpp"

#include <Eigen/LU>
#include <Eigen/StdVector>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fem/gather.hpp"
#include "fem/membrane_kernel.hpp"
#include "mesh/nodal.hpp"

namespace breast {

namespace {

// Faces of F nodes.
template <int F>
class MembraneOf final : public Term {
 public:
  MembraneOf(const HexMesh& mesh, const MechanicsOptions& options, const Discretisation& space);
  std::string name() const override { return "membrane"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override;

 private:
  using Volumes = Eigen::Matrix<double, QuadRule<F>::points, 1>;
  static constexpr int K = 9 * F * F;
  struct Results;
  bool face(int f, const State& state, const Request& request, CellMatrices* reference,
            Results& results) const;
  void add_results(const Results& results, const Request& request, Forces& forces) const;

  Law law_;
  SkinBehaviour skin_;
  Cells cells_;
  std::shared_ptr<const ScatterMap> scatter_;
  std::vector<Volumes, Eigen::aligned_allocator<Volumes>> volume_;  // of skin, per Gauss point
};

// Results of all faces are kept, so that sums are made in face order whatever the number of
// threads.
template <int F>
struct MembraneOf<F>::Results {
  std::vector<double> matrices, residuals, energies;
};

template <int F>
MembraneOf<F>::MembraneOf(const HexMesh& mesh, const MechanicsOptions& options,
                          const Discretisation& space)
    : law_(options.materials.law(Tissue::skin)), skin_(options.materials.skin) {
  const QuadRule<F>& rule = QuadRule<F>::get();
  const Eigen::VectorXd imaged = flatten(mesh.imaged);
  cells_.nodes_per_cell = F;
  for (std::size_t f = 0; f < mesh.skin_faces.size(); ++f) {
    const std::vector<int> nodes = face_nodes(mesh, mesh.skin_faces[f]);
    cells_.nodes.insert(cells_.nodes.end(), nodes.begin(), nodes.end());
    const Eigen::Matrix<double, 3, F> x = gather<F>(nodes.data(), imaged);
    Volumes volume;
    for (int q = 0; q < QuadRule<F>::points; ++q) {
      const Eigen::Matrix<double, 3, 2> t = x * rule.gradients[q].transpose();
      volume[q] =
          mesh.skin_thickness[f] * rule.weight[q] * std::sqrt((t.transpose() * t).determinant());
    }
    volume_.push_back(volume);
  }
  if (space.pattern) scatter_ = std::make_shared<ScatterMap>(*space.pattern, cells_);
}

template <int F>
bool MembraneOf<F>::face(int f, const State& state, const Request& request, CellMatrices* reference,
                         Results& results) const {
  MembraneInput<F> in;
  MembraneOutput<F> out;
  in.reference = gather<F>(cells_.cell(f), state.reference);
  in.deformed = gather<F>(cells_.cell(f), state.x);
  in.volume = volume_[f];
  in.law = &law_;
  in.skin = skin_;
  membrane_kernel<F>(in, {!results.matrices.empty(), request.reference != nullptr}, out);
  if (!out.valid) return false;
  results.energies[f] = out.energy;
  std::copy_n(out.residual.data(), 3 * F, results.residuals.data() + std::size_t(f) * 3 * F);
  if (!results.matrices.empty()) {
    std::copy_n(out.k.data(), K, results.matrices.data() + std::size_t(f) * K);
  }
  if (reference != nullptr) std::copy_n(out.k_x.data(), K, reference->at(f));
  return true;
}

template <int F>
bool MembraneOf<F>::add(const State& state, const Request& request, Forces& forces) const {
  const int count = cells_.count();
  const bool tangent = request.matrix != nullptr || request.packed != nullptr;
  CellMatrices* reference =
      request.reference != nullptr ? &request.reference->next(cells_) : nullptr;
  Results results;
  results.matrices.resize(tangent ? std::size_t(count) * K : 0);
  results.residuals.resize(std::size_t(count) * 3 * F);
  results.energies.resize(std::size_t(count));
  bool valid = true;
#pragma omp parallel for num_threads(threads()) schedule(static) reduction(&& : valid)
  for (int f = 0; f < count; ++f) valid = face(f, state, request, reference, results) && valid;
  if (valid) add_results(results, request, forces);
  return valid;
}

template <int F>
void MembraneOf<F>::add_results(const Results& results, const Request& request,
                                Forces& forces) const {
  const int count = cells_.count();
  for (int f = 0; f < count; ++f) {
    forces.energy += results.energies[f];
    for (int a = 0; a < 3 * F; ++a) {
      const long to = 3L * cells_.cell(f)[a / 3] + a % 3;
      const double value = results.residuals[std::size_t(f) * 3 * F + a];
      forces.r[to] += value;
      if (request.kappa != nullptr) forces.augmented[to] += value;
      if (request.matrix != nullptr) {
        request.matrix->diagonal[to] += results.matrices[std::size_t(f) * K + a * (3 * F + 1)];
      }
    }
  }
  if (request.matrix != nullptr) {
    request.matrix->stiffness.add_cells(*scatter_, 0, count, results.matrices.data());
  }
  if (request.packed != nullptr) {
    PackedCells& packed = request.packed->next(cells_);
    for (int f = 0; f < count; ++f) packed.set(f, results.matrices.data() + std::size_t(f) * K);
  }
}

template <int F>
std::vector<int> MembraneOf<F>::nodes() const {
  std::vector<int> all = cells_.nodes;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

std::shared_ptr<const Term> make_membrane(const HexMesh& mesh, const MechanicsOptions& options,
                                          const Discretisation& space) {
  if (mesh.skin_thickness.size() != mesh.skin_faces.size()) {
    throw input_error("mesh: membrane skin needs one thickness per skin face: ",
                      mesh.skin_thickness.size(), " given for ", mesh.skin_faces.size(), " faces");
  }
  if (mesh.order == 1) return std::make_shared<MembraneOf<4>>(mesh, options, space);
  return std::make_shared<MembraneOf<9>>(mesh, options, space);
}

}  // namespace breast
