// SPDX-License-Identifier: GPL-3.0-or-later
// The iterative methods: GMRES, conjugate gradients and Lanczos.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "fixtures/block.hpp"
#include "solve/krylov/conjugate_gradients.hpp"
#include "solve/krylov/gmres.hpp"
#include "solve/krylov/lanczos.hpp"
#include "solve/krylov/lowest_mode.hpp"

namespace breast {
namespace {

TEST(Gmres, SolvesAnUnsymmetricSystem) {
  const int n = 40;
  Eigen::MatrixXd a = 4 * Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd b(n);
  for (int i = 0; i < n; ++i) {
    b[i] = fixtures::noise(i);
    for (int j = 0; j < n; ++j) a(i, j) += 0.3 * fixtures::noise(100 + n * i + j);
  }
  const auto apply = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return a * v; };
  const auto quarter = [](const Eigen::VectorXd& v) -> Eigen::VectorXd { return v / 4; };
  const GmresResult result = gmres(apply, quarter, b, 1e-12, n);
  EXPECT_TRUE(result.converged);
  EXPECT_LT((a * result.x - b).norm(), 1e-11 * b.norm());
}

Eigen::MatrixXd known_spectrum(const Eigen::VectorXd& eigenvalues) {
  const Eigen::MatrixXd any = Eigen::MatrixXd::NullaryExpr(
      eigenvalues.size(), eigenvalues.size(),
      [](long i, long j) { return fixtures::noise(int(1000 * i + j)); });
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(any).householderQ();
  return q * eigenvalues.asDiagonal() * q.transpose();
}

TEST(ConjugateGradients, SolveToEitherLimitAndStopWithoutCurvature) {
  const Eigen::MatrixXd a = known_spectrum(Eigen::VectorXd::LinSpaced(30, 1, 50));
  const Eigen::VectorXd b = Eigen::VectorXd::Ones(30);
  const auto apply = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return a * v; };
  const auto half = [](const Eigen::VectorXd& v) -> Eigen::VectorXd { return v / 2; };
  const ConjugateGradientResult fine = conjugate_gradients(apply, half, b, {1e-10, 0, 100});
  EXPECT_TRUE(fine.converged);
  EXPECT_NEAR(fine.start, std::sqrt(15), 1e-12);
  EXPECT_LT((a * fine.x - b).norm(), 1e-9 * b.norm());
  const ConjugateGradientResult rough = conjugate_gradients(apply, half, b, {0, 0.5, 100});
  EXPECT_TRUE(rough.converged);
  EXPECT_NEAR(rough.residual, (a * rough.x - b).norm() / std::sqrt(2), 1e-12);
  EXPECT_LE(rough.residual, 0.5);
  EXPECT_LT(rough.iterations, fine.iterations);
  EXPECT_FALSE(conjugate_gradients(apply, half, b, {1e-10, 0, 3}).converged);
  const auto negative = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return -(a * v); };
  const ConjugateGradientResult none = conjugate_gradients(negative, half, b, {1e-10, 0, 100});
  EXPECT_FALSE(none.converged);
  EXPECT_EQ(none.iterations, 0);
}

// A dense spectrum with a few eigenvalues above it, and a start that hardly contains their vectors.
TEST(Lanczos, BoundsTheLargestEigenvalue) {
  Eigen::VectorXd eigenvalues = Eigen::VectorXd::LinSpaced(200, 0.01, 4);
  eigenvalues.tail(3) << 5.5, 5.6, 5.7;
  const Eigen::MatrixXd a = known_spectrum(eigenvalues);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a);
  Eigen::VectorXd start = Eigen::VectorXd::Ones(200);
  start -= 0.95 * eigen.eigenvectors().rightCols(3) *
           (eigen.eigenvectors().rightCols(3).transpose() * start);
  const auto apply = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return a * v; };
  const double bound = largest_eigenvalue(apply, start, 12);
  EXPECT_GE(bound, 5.7);
  EXPECT_LE(bound, 1.1 * 5.7);
  const auto twice = [](const Eigen::VectorXd& v) -> Eigen::VectorXd { return 2 * v; };
  EXPECT_EQ(largest_eigenvalue(twice, Eigen::VectorXd::Unit(9, 4), 12), 2);
}

// The sign of the lowest eigenvalue, preconditioned or not, also where it is a thousandth of the
// others; and no verdict where it is zero.
TEST(Lanczos, KnowsTheSignOfTheLowestEigenvalue) {
  Eigen::VectorXd scales = Eigen::VectorXd::LinSpaced(200, 1, 100), start(200);
  for (int i = 0; i < 200; ++i) start[i] = fixtures::noise(i);
  const auto verdict = [&](double lowest) {
    Eigen::VectorXd eigenvalues = Eigen::VectorXd::LinSpaced(200, 0.3, 1.2);
    eigenvalues[0] = lowest;
    const Eigen::MatrixXd a =
        scales.asDiagonal() * known_spectrum(eigenvalues) * scales.asDiagonal();
    return lowest_eigenvalue([&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return a * v; },
                             [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
                               return v.cwiseQuotient(scales.cwiseAbs2());
                             },
                             start, 100);
  };
  const LowestEigenvalue above = verdict(1e-3), below = verdict(-1e-3), zero = verdict(0);
  EXPECT_TRUE(above.positive());
  EXPECT_NEAR(above.value, 1e-3, 1e-6);
  EXPECT_LT(above.steps, 50);
  EXPECT_FALSE(below.positive());
  EXPECT_LT(below.value, 0);
  EXPECT_FALSE(zero.positive());
}

// Of a map with two negative eigenvalues, with weights and with no more than a rough inverse of it.
TEST(LowestMode, IsThatOfTheDenseSolver) {
  const int n = 60;
  Eigen::VectorXd eigenvalues = Eigen::VectorXd::LinSpaced(n, 1, 80), weight(n), start(n);
  eigenvalues[0] = -0.3;
  eigenvalues[1] = -0.1;
  const Eigen::MatrixXd a = known_spectrum(eigenvalues);
  for (int i = 0; i < n; ++i) {
    weight[i] = 2 + fixtures::noise(7 + i);
    start[i] = fixtures::noise(500 + i);
  }
  const Eigen::MatrixXd shifted = a + 2 * Eigen::MatrixXd::Identity(n, n);
  const Eigen::LLT<Eigen::MatrixXd> factor(shifted);
  const LowestMode found =
      lowest_mode([&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return a * v; },
                  [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return factor.solve(v); },
                  weight, start, 1e-12, 100);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
      a, Eigen::MatrixXd(weight.asDiagonal()));
  EXPECT_NEAR(found.value, dense.eigenvalues()[0], 1e-9);
  EXPECT_NEAR(std::abs(found.mode.dot(weight.cwiseProduct(dense.eigenvectors().col(0)))), 1, 1e-6);
  EXPECT_LT(found.steps, 40);
}

}  // namespace
}  // namespace breast
