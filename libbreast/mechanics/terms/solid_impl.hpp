// SPDX-License-Identifier: GPL-3.0-or-later
// Implementation of the solid for elements of one kind, shared by its two parts: the imaged shape
// (solid.cpp) and the pass over the elements (solid_pass.cpp).
#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "fem/gather.hpp"
#include "fem/hex_kernel.hpp"
#include "mechanics/terms/solid.hpp"

namespace breast {

// Elements of N nodes with P pressures.
template <int N, int P>
class SolidOf final : public Solid {
 public:
  SolidOf(const HexMesh& mesh, const MechanicsOptions& options, TangentStorage storage);
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<double> mean_pressure(const Eigen::VectorXd& p) const override;
  std::vector<double> mean_det_f(const Eigen::VectorXd& reference,
                                 const Eigen::VectorXd& deformed) const override;

 private:
  static constexpr int K = 9 * N * N;
  static constexpr int element_chunk = N == 8 ? 512 : 64;
  using Basis = Eigen::Matrix<double, P, HexRule<N>::points>;
  struct Chunk;
  struct Targets;

  void set_imaged(const HexMesh& mesh, const MechanicsOptions& options, TangentStorage storage);
  const Cells& cells() const { return space_->cells; }
  const PressureSpace& pressures() const { return *space_->pressures; }
  bool element(int e, const State& state, const Request& request, HexOutput<N, P>& out) const;
  void store(int e, int at, const State& state, const Targets& targets, HexOutput<N, P>& out,
             Forces& forces, Chunk& chunk) const;
  double store_tangent(int e, int at, const Targets& targets, HexOutput<N, P>& out,
                       Chunk& chunk) const;
  void add_chunk(int first, int count, const Request& request, const Chunk& chunk,
                 Forces& forces) const;
  double shear_of(int e, const HexOutput<N, P>& out) const;
  double kappa_of(int e, const Request& request, double shear) const;

  bool isochoric_;
  double bulk_ratio_;
  std::vector<Law> laws_;  // by tissue
  std::vector<int> law_of_;
  std::vector<Basis, Eigen::aligned_allocator<Basis>> basis_;
  std::shared_ptr<const ScatterMap> scatter_;
};

}  // namespace breast
