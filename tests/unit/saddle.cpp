// SPDX-License-Identifier: GPL-3.0-or-later
// The linear algebra against dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <numbers>
#include <utility>

#include "core/parallel.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/block.hpp"
#include "fixtures/in_place.hpp"
#include "mechanics/scene.hpp"
#include "solve/krylov/lanczos.hpp"

namespace breast {
namespace {

struct Small {
  HexMesh mesh;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Problem> problem;
  State state;

  explicit Small(double bulk_ratio, SolverOption solver = SolverOption::direct) {
    fixtures::BlockSettings settings;
    settings.elements = {2, 2, 2};
    settings.size = Vec3(20, 20, 20);
    settings.distortion = 0.2;
    settings.skin_mm = 1;
    mesh = fixtures::block(settings);
    MechanicsOptions options;
    options.materials = load_materials("seed2008");
    options.bulk_ratio = bulk_ratio;
    options.solver = solver;
    scene = std::make_unique<Scene>(mesh, options);
    const Eigen::VectorXd load = scene->gravity_force(Vec3(0, 0, -9810));
    problem = std::make_unique<Problem>(scene->problem(load).problem);
    state = scene->at_rest(flatten(mesh.reference));
    state.p = Eigen::VectorXd::Constant(8, 40);
    for (long i = 0; i < state.x.size(); ++i) state.x[i] += 0.2 * fixtures::noise(int(i));
  }
};

Eigen::MatrixXd dense(const NodeMatrix& matrix) {
  const int n = matrix.pattern().unknowns();
  Eigen::MatrixXd out(n, n);
  for (int j = 0; j < n; ++j) out.col(j) = matrix.multiply(Eigen::VectorXd::Unit(n, j));
  return out;
}

// The solver's step satisfies the constrained saddle system, with a rotated prescribed increment.
void expect_constrained_solution(SolverOption kind) {
  for (const double bulk_ratio : {0.0, 300.0}) {
    Small small(bulk_ratio, kind);
    SaddleMatrix matrix = small.problem->make_matrix();
    Forces forces;
    ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
    Constraints held = small.scene->walls();
    const int touched = fixtures::node_at(small.mesh, Vec3(20, 10, 20));
    const Vec3 normal = Vec3(0.3, -0.2, 1).normalized();
    held.hold_normal(touched, normal, -0.15);
    SaddleSolver solver(small.problem->space().pattern, small.scene->solid().solver());
    ASSERT_TRUE(solver.factorise(matrix, held).ok);
    const SaddleStep step = solver.solve(matrix, forces.r, forces.theta, 1e-12);

    EXPECT_NEAR(normal.dot(step.u.segment<3>(3L * touched)), -0.15, 1e-12);
    Eigen::VectorXd momentum =
        matrix.multiply_unaugmented(step.u) - matrix.divergence.apply_transpose(step.p) + forces.r;
    const double scale = forces.r.norm() + matrix.multiply_unaugmented(step.u).norm();
    held.project(momentum);
    EXPECT_LT(momentum.norm(), 1e-8 * scale);
    const Eigen::VectorXd volume = matrix.divergence.apply(step.u) +
                                   matrix.space->multiply(step.p, matrix.space->compliance) +
                                   forces.theta;
    EXPECT_LT(volume.norm(), 1e-8 * forces.theta.norm());
  }
}

TEST(SaddleSolver, SolvesTheConstrainedSystem) {
  expect_constrained_solution(SolverOption::direct);
}

TEST(SaddleSolver, SolvesItByMultigridAsWell) {
  expect_constrained_solution(SolverOption::multigrid);
}

// A body at rest under gravity, its tangent assembled for multigrid, and a solver of either kind.
struct AtRest {
  HexMesh mesh;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<Problem> problem;
  std::unique_ptr<SaddleMatrix> matrix;
  Forces forces;
  std::unique_ptr<SaddleSolver> solver;

  AtRest(HexMesh body, LinearSolver kind) : mesh(std::move(body)) {
    MechanicsOptions options;
    options.materials = load_materials("seed2008");
    options.solver = SolverOption::multigrid;
    if (mesh.reference.empty()) mesh.reference = mesh.points;
    scene = std::make_unique<Scene>(mesh, options);
    const Eigen::VectorXd rest = flatten(mesh.reference);
    problem =
        std::make_unique<Problem>(scene->problem(scene->gravity_force(Vec3(0, 0, -9810))).problem);
    matrix = std::make_unique<SaddleMatrix>(problem->make_matrix());
    EXPECT_TRUE(problem->tangent(scene->at_rest(rest), forces, *matrix));
    solver = std::make_unique<SaddleSolver>(problem->space().pattern, kind);
    EXPECT_TRUE(solver->factorise(*matrix, scene->walls(), false).ok);
  }
};

HexMesh cube(int n, double distortion) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  settings.distortion = distortion;
  return fixtures::block(settings);
}

// GMRES iterations of one step to a relative residual of 1e-6, exactly incompressible.
int cycles_needed(const HexMesh& mesh) {
  const AtRest body(mesh, LinearSolver::multigrid);
  return body.solver->solve(*body.matrix, body.forces.r, body.forces.theta, 1e-5).iterations;
}

// By less than half in eight times the elements, distorted or not; and no more than a
// smoother with too low an interval (46 on the dome) or a mass matrix for the pressure (50
// on the finer cubes) takes.
TEST(Multigrid, IterationsGrowSlowlyWithTheMesh) {
  for (const double distortion : {0.0, 0.2}) {
    const int coarse = cycles_needed(cube(10, distortion));
    const int fine = cycles_needed(cube(20, distortion));
    EXPECT_LE(fine, 1.5 * coarse) << distortion;
    EXPECT_LE(fine, 25) << distortion;
  }
  EXPECT_LE(cycles_needed(analytic_breast_mesh(14)), 25);
}

// S q of a pressure q, by a factor, and back: what stands for S⁻¹ keeps the size of a pressure that
// alternates from element to element, which κM⁻¹ makes a tenth of, and of a smooth one.
TEST(PressureSchur, InvertsSmoothAndAlternatingPressures) {
  const int n = 12;
  const AtRest exact(cube(n, 0), LinearSolver::direct), cycles(cube(n, 0), LinearSolver::multigrid);
  const ElementRows& b = exact.matrix->divergence;
  const auto sizes = [&](auto&& pressure) {
    Eigen::VectorXd p(exact.mesh.elements());
    for (int e = 0; e < p.size(); ++e) p[e] = pressure(e % n, e / n % n, e / n / n);
    const Eigen::VectorXd sp = b.apply(exact.solver->back_solve(b.apply_transpose(p)));
    const auto part = [&](const AtRest& body) {
      return p.dot(body.solver->schur_solve(*body.matrix, sp)) / p.squaredNorm();
    };
    return std::pair{part(cycles), part(exact)};
  };
  const auto middle = [](int i) { return std::sin(std::numbers::pi * (i + 0.5) / n); };
  const auto [alternating, by_mass] = sizes([&](int i, int j, int k) {
    return ((i + j) % 2 == 0 ? 1 : -1) * middle(i) * middle(j) * middle(2 * k);
  });
  EXPECT_NEAR(alternating, 1, 0.5);
  EXPECT_LT(by_mass, 0.2);
  const auto [smooth, smooth_by_mass] =
      sizes([&](int i, int j, int k) { return middle(i) * middle(j) * middle(k); });
  EXPECT_NEAR(smooth, 1, 0.5);
  EXPECT_NEAR(smooth_by_mass, 1, 0.5);
}

// A tangent moved down by a multiple of its diagonal: cycles say what a factor says, at a
// thousandth of the multiple where it changes.
TEST(Multigrid, KnowsDefinitenessAsAFactorDoes) {
  AtRest cycles(cube(10, 0.2), LinearSolver::multigrid), exact(cube(10, 0.2), LinearSolver::direct);
  const auto definite = [&](AtRest& body, double by) {
    const SaddleMatrix before = *body.matrix;
    for (int node = 0; node < body.mesh.nodes(); ++node) {
      const double size = body.matrix->diagonal.segment<3>(3L * node).mean();
      body.matrix->stiffness.add_to_node(node, -by * size * Mat3::Identity());
    }
    const bool yes = body.solver->factorise(*body.matrix, body.scene->walls(), false).ok &&
                     body.solver->positive_definite();
    *body.matrix = before;
    return yes;
  };
  double low = 0, high = 1;
  ASSERT_TRUE(definite(exact, low));
  ASSERT_FALSE(definite(exact, high));
  while (high - low > 1e-6 * high)
    (definite(exact, 0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
  for (const double part : {0.0, 0.5, 0.99, 0.999})
    EXPECT_TRUE(definite(cycles, part * low)) << part;
  for (const double part : {1.001, 1.01, 2.0}) EXPECT_FALSE(definite(cycles, part * high)) << part;
}

TEST(Multigrid, FindsTheEquilibriumOfTheDirectSolver) {
  fixtures::BlockSettings settings;
  settings.elements = {6, 6, 6};
  settings.distortion = 0.2;
  settings.skin_mm = 1.5;
  HexMesh direct = fixtures::block(settings), cycles = direct;
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.solver = SolverOption::direct;
  ASSERT_TRUE(fixtures::forward_into(direct, Vec3(0, 0, -9810), options).converged());
  options.solver = SolverOption::multigrid;
  const SolveSummary summary = fixtures::forward_into(cycles, Vec3(0, 0, -9810), options);
  ASSERT_TRUE(summary.converged());
  EXPECT_EQ(summary.linear_solver, "multigrid");
  EXPECT_LE(summary.newton_iterations, 10);
  double apart = 0;
  for (int i = 0; i < direct.nodes(); ++i) {
    apart = std::max(apart, (direct.points[i] - cycles.points[i]).norm());
  }
  EXPECT_LT(apart, 1e-7);
}

TEST(SaddleSolver, IndefiniteMatrixIsShiftedAndSaidToBe) {
  Small small(0);
  SaddleMatrix matrix = small.problem->make_matrix();
  Forces forces;
  ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
  const int node = fixtures::node_at(small.mesh, Vec3(20, 20, 20));
  matrix.stiffness.add_to_node(node, -1e6 * Mat3::Identity());
  SaddleSolver solver(small.problem->space().pattern);
  EXPECT_FALSE(solver.factorise(matrix, small.scene->walls(), false).ok);
  matrix = small.problem->make_matrix();
  ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
  const double own = matrix.diagonal.segment<3>(3L * node).mean();
  matrix.stiffness.add_to_node(node, -2 * own * Mat3::Identity());
  const Factorisation factor = solver.factorise(matrix, small.scene->walls());
  EXPECT_TRUE(factor.ok);
  EXPECT_GT(factor.shift, 0);
  EXPECT_GT(factor.attempts, 1);
  // The search begins near the last shift, also after a tangent that needs none.
  SaddleMatrix definite = small.problem->make_matrix();
  ASSERT_TRUE(small.problem->tangent(small.state, forces, definite));
  EXPECT_EQ(solver.factorise(definite, small.scene->walls()).shift, 0);
  const Factorisation again = solver.factorise(matrix, small.scene->walls());
  EXPECT_EQ(again.shift, factor.shift);
  EXPECT_LT(again.attempts, factor.attempts);
}

TEST(NodeMatrix, IsSymmetricAndMatchesItsBlocks) {
  Small small(0);
  SaddleMatrix matrix = small.problem->make_matrix();
  Forces forces;
  ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
  const Eigen::MatrixXd k = dense(matrix.stiffness);
  EXPECT_LT((k - k.transpose()).norm(), 1e-12 * k.norm());
  for (int column = 0; column < small.mesh.nodes(); column += 5) {
    const NodePattern& pattern = matrix.stiffness.pattern();
    for (int slot = -1; slot < pattern.rows_count(column); ++slot) {
      const int row = slot < 0 ? column : pattern.rows_begin(column)[slot];
      EXPECT_LT((matrix.stiffness.block(column, slot) - k.block<3, 3>(3 * row, 3 * column)).norm(),
                1e-12 * k.norm());
    }
  }
  const double h = 1e-5;  // K without its augmentation is the derivative of the residual
  Eigen::VectorXd direction(small.state.x.size());
  for (long i = 0; i < direction.size(); ++i) direction[i] = fixtures::noise(int(i) + 77);
  State up = small.state, down = small.state;
  up.x += h * direction;
  down.x -= h * direction;
  const Eigen::VectorXd difference =
      (small.problem->forces(up, nullptr).r - small.problem->forces(down, nullptr).r) / (2 * h);
  EXPECT_LT((difference - matrix.multiply_unaugmented(direction)).norm(), 1e-6 * difference.norm());
}

// Fronts of all sizes, tiles and subtrees: the solution of a dense solver, the same bits on any
// number of threads, and no factor where there is none.
TEST(Cholesky, MatchesADenseSolverOnAnyNumberOfThreads) {
  fixtures::BlockSettings settings;
  settings.elements = {9, 8, 7};
  const HexMesh mesh = fixtures::block(settings);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  const Scene scene(mesh, options);
  const Problem problem = scene.problem(Eigen::VectorXd::Zero(3L * mesh.nodes())).problem;
  SaddleMatrix matrix = problem.make_matrix();
  Forces forces;
  ASSERT_TRUE(problem.tangent(scene.at_rest(flatten(mesh.reference)), forces, matrix));
  for (int node = 0; node < mesh.nodes(); ++node) {
    matrix.stiffness.add_to_node(node, matrix.diagonal.mean() * Mat3::Identity());
  }
  Eigen::VectorXd right(3L * mesh.nodes());
  for (long i = 0; i < right.size(); ++i) right[i] = fixtures::noise(int(i));
  const Eigen::VectorXd exact = dense(matrix.stiffness).llt().solve(right);
  const int before = threads();
  Cholesky cholesky(*problem.space().pattern);
  set_threads(1);
  ASSERT_TRUE(cholesky.factorise(matrix.stiffness.values()));
  const Eigen::VectorXd alone = cholesky.solve(right);
  set_threads(3);
  ASSERT_TRUE(cholesky.factorise(matrix.stiffness.values()));
  EXPECT_EQ(cholesky.solve(right), alone);
  EXPECT_LT((alone - exact).norm(), 1e-11 * exact.norm());
  for (const double bad : {-1e12, std::numeric_limits<double>::quiet_NaN()}) {
    NodeMatrix spoiled = matrix.stiffness;
    spoiled.add_to_node(mesh.nodes() / 2, bad * Mat3::Identity());
    EXPECT_FALSE(cholesky.factorise(spoiled.values()));
  }
  ASSERT_TRUE(cholesky.factorise(matrix.stiffness.values()));
  EXPECT_EQ(cholesky.solve(right), alone);
  set_threads(before);
}

TEST(Constraints, ProjectAndRotate) {
  Constraints held(2);
  held.hold_normal(1, Vec3(0, 0.6, 0.8), 2.0);
  Eigen::VectorXd v(6);
  v << 1, 2, 3, 4, 5, 6;
  Eigen::VectorXd projected = v;
  held.project(projected);
  EXPECT_EQ(projected.head<3>(), v.head<3>());
  EXPECT_NEAR(Vec3(0, 0.6, 0.8).dot(projected.tail<3>()), 0, 1e-14);
  Eigen::VectorXd turned = v;
  held.to_axes(turned);
  held.from_axes(turned);
  EXPECT_LT((turned - v).norm(), 1e-14);
  EXPECT_NEAR(held.increments().tail<3>().norm(), 2, 1e-14);
}

}  // namespace
}  // namespace breast
