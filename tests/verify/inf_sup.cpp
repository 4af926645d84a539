// SPDX-License-Identifier: GPL-3.0-or-later
// The numerical inf-sup test (Chapelle and Bathe, Comput. Struct. 47:537, 1993) of both elements on
// the unit cube held at one face: β² is the least eigenvalue of B A⁻¹ Bᵀ q = β² M q, A the H¹
// stiffness, B the kernels' volume derivative, M the pressure mass. A stable element's β stays
// above a bound as the mesh is refined.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "fem/hex_kernel.hpp"
#include "fixtures/block.hpp"

namespace breast {
namespace {

const Law any{"neo_hookean", {1}};

template <int N, int P>
struct Systems {
  Eigen::MatrixXd stiffness;         ///< A of one displacement component
  std::array<Eigen::MatrixXd, 3> b;  ///< pressures × free nodes, per component
  Eigen::MatrixXd mass;
};

// One element's kernel input at rest; pressure basis 1, (x − centre)/h.
template <int N, int P>
HexInput<N, P> at_rest(const HexMesh& mesh, int e) {
  HexInput<N, P> in;
  const HexRule<N>& rule = HexRule<N>::get();
  for (int a = 0; a < N; ++a) in.reference.col(a) = mesh.reference[mesh.element(e)[a]];
  in.deformed = in.reference;
  in.pressure.setZero();
  in.law = &any;
  const Vec3 centre = in.reference.rowwise().mean();
  const double h = in.reference.row(0).maxCoeff() - in.reference.row(0).minCoeff();
  for (int q = 0; q < HexRule<N>::points; ++q) {
    in.basis(0, q) = 1;
    if constexpr (P == 4) {
      in.basis.col(q).template tail<3>() = (in.reference * rule.values[q] - centre) / h;
    }
  }
  return in;
}

template <int N, int P>
Systems<N, P> assemble(const HexMesh& mesh) {
  std::vector<int> free(mesh.reference.size(), -1);
  int count = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    if (mesh.reference[i].x() > 1e-9) free[i] = count++;
  }
  Systems<N, P> out;
  out.stiffness = Eigen::MatrixXd::Zero(count, count);
  for (auto& b : out.b) b = Eigen::MatrixXd::Zero(P * mesh.elements(), count);
  out.mass = Eigen::MatrixXd::Zero(P * mesh.elements(), P * mesh.elements());
  const HexRule<N>& rule = HexRule<N>::get();
  const auto kernel = std::make_unique<HexOutput<N, P>>();
  for (int e = 0; e < mesh.elements(); ++e) {
    const HexInput<N, P> in = at_rest<N, P>(mesh, e);
    hex_kernel<N, P>(in, {}, *kernel);
    EXPECT_TRUE(kernel->valid);
    for (int q = 0; q < HexRule<N>::points; ++q) {
      const Mat3 jacobian = in.reference * rule.gradients[q].transpose();
      const double volume = rule.weight[q] * jacobian.determinant();
      const Eigen::Matrix<double, N, 3> g = rule.gradients[q].transpose() * jacobian.inverse();
      const Eigen::Matrix<double, P, 1> psi = in.basis.col(q);
      out.mass.template block<P, P>(P * e, P * e) += volume * psi * psi.transpose();
      for (int a = 0; a < N; ++a) {
        for (int b = 0; b < N; ++b) {
          const int i = free[mesh.element(e)[a]], j = free[mesh.element(e)[b]];
          if (i >= 0 && j >= 0) out.stiffness(i, j) += volume * g.row(a).dot(g.row(b));
        }
      }
    }
    for (int a = 0; a < N; ++a) {
      const int i = free[mesh.element(e)[a]];
      if (i < 0) continue;
      for (int c = 0; c < 3; ++c) {
        out.b[c].template block<P, 1>(P * e, i) += kernel->b.col(3 * a + c);
      }
    }
  }
  return out;
}

template <int N, int P>
double inf_sup(int n, double distortion = 0) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  settings.size = Vec3::Ones();
  settings.order = N == 8 ? 1 : 2;
  settings.distortion = distortion;
  const Systems<N, P> s = assemble<N, P>(fixtures::block(settings));
  const Eigen::LLT<Eigen::MatrixXd> factor(s.stiffness);
  Eigen::MatrixXd schur = Eigen::MatrixXd::Zero(s.mass.rows(), s.mass.rows());
  for (const Eigen::MatrixXd& b : s.b) {
    const Eigen::MatrixXd half = factor.matrixL().solve(b.transpose());
    schur.noalias() += half.transpose() * half;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(schur, s.mass,
                                                                        Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
}

TEST(InfSup, QuadraticElementIsBoundedBelow) {
  const double two = inf_sup<27, 4>(2), three = inf_sup<27, 4>(3), four = inf_sup<27, 4>(4);
  EXPECT_NEAR(two, 0.728, 0.005);
  EXPECT_NEAR(three, 0.635, 0.005);
  EXPECT_NEAR(four, 0.610, 0.005);
  EXPECT_GT(four, 0.9 * three);
}

TEST(InfSup, LinearElementDecays) {
  const double two = inf_sup<8, 1>(2), four = inf_sup<8, 1>(4), six = inf_sup<8, 1>(6);
  EXPECT_NEAR(two, 0.658, 0.005);
  EXPECT_NEAR(four, 0.238, 0.005);
  EXPECT_NEAR(six, 0.121, 0.005);
  const double order = std::log(four / six) / std::log(6.0 / 4);
  EXPECT_GT(order, 1.2);  // faster than h: pressures are not to be trusted unfiltered
}

TEST(InfSup, DistortionDoesNotCureTheLinearElement) {
  EXPECT_LT((inf_sup<8, 1>(6, 0.2)), 0.6 * (inf_sup<8, 1>(4, 0.2)));
}

}  // namespace
}  // namespace breast
