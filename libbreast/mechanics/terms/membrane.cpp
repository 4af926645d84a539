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
#include "solve/cell_results.hpp"

namespace breast {

namespace {

// Faces of F nodes.
template <int F>
class MembraneOf final : public Term {
 public:
  MembraneOf(const HexMesh& mesh, const MechanicsOptions& options, const Discretisation& space);
  std::string name() const override { return "membrane"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override { return nodes_of_cells(cells_); }

 private:
  using Volumes = Eigen::Matrix<double, QuadRule<F>::points, 1>;
  static constexpr int K = 9 * F * F;
  bool face(int f, const State& state, const Request& request, CellMatrices* reference,
            CellResults& results) const;

  Law law_;
  SkinBehaviour skin_;
  Cells cells_;
  std::shared_ptr<const ScatterMap> scatter_;
  std::vector<Volumes, Eigen::aligned_allocator<Volumes>> volume_;  // of skin, per Gauss point
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
                         CellResults& results) const {
  MembraneInput<F> in;
  MembraneOutput<F> out;
  in.reference = gather<F>(cells_.cell(f), state.reference);
  in.deformed = gather<F>(cells_.cell(f), state.x);
  in.volume = volume_[f];
  in.law = &law_;
  in.skin = skin_;
  membrane_kernel<F>(in, {results.with_tangent(), request.reference != nullptr}, out);
  if (!out.valid) return false;
  results.energies[f] = out.energy;
  std::copy_n(out.residual.data(), 3 * F, results.residual(f));
  if (results.with_tangent()) {
    std::copy_n(out.k.data(), K, results.matrix(f));
  }
  if (reference != nullptr) std::copy_n(out.k_x.data(), K, reference->at(f));
  return true;
}

template <int F>
bool MembraneOf<F>::add(const State& state, const Request& request, Forces& forces) const {
  const int count = cells_.count();
  CellMatrices* reference =
      request.reference != nullptr ? &request.reference->next(cells_) : nullptr;
  CellResults results(cells_, request);
  bool valid = true;
#pragma omp parallel for num_threads(threads()) schedule(static) reduction(&& : valid)
  for (int f = 0; f < count; ++f) valid = face(f, state, request, reference, results) && valid;
  if (valid) results.add_to(request, scatter_.get(), forces);
  return valid;
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
