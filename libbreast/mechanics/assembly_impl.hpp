// The assembly over elements of one kind: what its two parts, the imaged shape (assembly.cpp) and
// the pass over elements and faces (assembly_pass.cpp), share.
#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "fem/hex_kernel.hpp"
#include "fem/membrane_kernel.hpp"
#include "mechanics/assembly.hpp"

namespace breast {

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
  static constexpr int element_chunk = N == 8 ? 512 : 64;
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
  double shear_of(int e, const HexOutput<N, P>& out) const;
  double kappa_of(int e, double augmentation, double shear) const;

  bool isochoric_;
  double bulk_ratio_;
  std::vector<Law> laws_;  // by tissue
  std::vector<int> law_of_;
  std::vector<Basis, Eigen::aligned_allocator<Basis>> basis_;
  std::vector<Eigen::Matrix<double, QuadRule<F>::points, 1>,
              Eigen::aligned_allocator<Eigen::Matrix<double, QuadRule<F>::points, 1>>>
      skin_volume_;
};

}  // namespace breast
