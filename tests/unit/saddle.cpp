// The linear algebra against dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "core/parallel.hpp"
#include "fixtures/block.hpp"
#include "mechanics/scene.hpp"
#include "solve/gmres.hpp"

namespace breast {
namespace {

struct Small {
  HexMesh mesh;
  std::unique_ptr<Scene> scene;
  std::unique_ptr<ForwardProblem> problem;
  SaddleState state;

  explicit Small(double bulk_ratio, const char* solver = "direct") {
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
    problem = std::make_unique<ForwardProblem>(*scene, flatten(mesh.reference),
                                               scene->gravity_force(Vec3(0, 0, -9810)));
    state = {flatten(mesh.reference), Eigen::VectorXd::Constant(8, 40)};
    for (long i = 0; i < state.u.size(); ++i) state.u[i] += 0.2 * fixtures::noise(int(i));
  }
};

Eigen::MatrixXd dense(const NodeMatrix& matrix) {
  const int n = matrix.pattern().unknowns();
  Eigen::MatrixXd out(n, n);
  for (int j = 0; j < n; ++j) out.col(j) = matrix.multiply(Eigen::VectorXd::Unit(n, j));
  return out;
}

// The solver's step satisfies the constrained saddle system, with a rotated prescribed increment.
void expect_constrained_solution(const char* kind) {
  for (const double bulk_ratio : {0.0, 300.0}) {
    Small small(bulk_ratio, kind);
    SaddleMatrix matrix = small.problem->make_matrix();
    SaddleForces forces;
    ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
    Constraints held = small.scene->walls();
    const int touched = fixtures::node_at(small.mesh, Vec3(20, 10, 20));
    const Vec3 normal = Vec3(0.3, -0.2, 1).normalized();
    held.hold_normal(touched, normal, -0.15);
    SaddleSolver solver(small.problem->pattern(), small.scene->assembly().solver());
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
  expect_constrained_solution("direct");
}

TEST(SaddleSolver, SolvesItByMultigridAsWell) {
  expect_constrained_solution("multigrid");
}

// GMRES iterations of one step on a block of n³ elements, exactly incompressible.
int cycles_needed(int n) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  settings.distortion = 0.2;
  const HexMesh mesh = fixtures::block(settings);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.solver = "multigrid";
  const Scene scene(mesh, options);
  const ForwardProblem problem(scene, flatten(mesh.reference),
                               scene.gravity_force(Vec3(0, 0, -9810)));
  SaddleMatrix matrix = problem.make_matrix();
  SaddleForces forces;
  EXPECT_TRUE(
      problem.tangent({flatten(mesh.reference), scene.assembly().rest_pressure()}, forces, matrix));
  SaddleSolver solver(problem.pattern(), scene.assembly().solver());
  EXPECT_TRUE(solver.factorise(matrix, scene.walls()).ok);
  return solver.solve(matrix, forces.r, forces.theta, 1e-5).iterations;
}

// They do grow, more than a multigrid should: docs/validation.md, section 2.
TEST(Multigrid, IterationsGrowSlowlyWithTheMesh) {
  const int coarse = cycles_needed(6), fine = cycles_needed(12);
  RecordProperty("coarse", coarse);
  RecordProperty("fine", fine);
  EXPECT_LE(fine, 2 * coarse);
  EXPECT_LE(fine, 45);
}

TEST(Multigrid, FindsTheEquilibriumOfTheDirectSolver) {
  fixtures::BlockSettings settings;
  settings.elements = {6, 6, 6};
  settings.distortion = 0.2;
  settings.skin_mm = 1.5;
  HexMesh direct = fixtures::block(settings), cycles = direct;
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.solver = "direct";
  ASSERT_TRUE(solve_forward(direct, Vec3(0, 0, -9810), options).converged());
  options.solver = "multigrid";
  const SolveSummary summary = solve_forward(cycles, Vec3(0, 0, -9810), options);
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
  SaddleForces forces;
  ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
  const int node = fixtures::node_at(small.mesh, Vec3(20, 20, 20));
  matrix.stiffness.add_to_node(node, -1e6 * Mat3::Identity());
  SaddleSolver solver(small.problem->pattern());
  EXPECT_FALSE(solver.factorise(matrix, small.scene->walls(), false).ok);
  matrix = small.problem->make_matrix();
  ASSERT_TRUE(small.problem->tangent(small.state, forces, matrix));
  const double own = matrix.diagonal.segment<3>(3L * node).mean();
  matrix.stiffness.add_to_node(node, -2 * own * Mat3::Identity());
  const Factorisation factor = solver.factorise(matrix, small.scene->walls());
  EXPECT_TRUE(factor.ok);
  EXPECT_GT(factor.shift, 0);
  EXPECT_GT(factor.attempts, 1);
}

TEST(NodeMatrix, IsSymmetricAndMatchesItsBlocks) {
  Small small(0);
  SaddleMatrix matrix = small.problem->make_matrix();
  SaddleForces forces;
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
  Eigen::VectorXd direction(small.state.u.size());
  for (long i = 0; i < direction.size(); ++i) direction[i] = fixtures::noise(int(i) + 77);
  SaddleState up = small.state, down = small.state;
  up.u += h * direction;
  down.u -= h * direction;
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
  const ForwardProblem problem(scene, flatten(mesh.reference),
                               Eigen::VectorXd::Zero(3L * mesh.nodes()));
  SaddleMatrix matrix = problem.make_matrix();
  SaddleForces forces;
  ASSERT_TRUE(
      problem.tangent({flatten(mesh.reference), scene.assembly().rest_pressure()}, forces, matrix));
  for (int node = 0; node < mesh.nodes(); ++node) {
    matrix.stiffness.add_to_node(node, matrix.diagonal.mean() * Mat3::Identity());
  }
  Eigen::VectorXd right(3L * mesh.nodes());
  for (long i = 0; i < right.size(); ++i) right[i] = fixtures::noise(int(i));
  const Eigen::VectorXd exact = dense(matrix.stiffness).llt().solve(right);
  const int before = threads();
  Cholesky cholesky(*problem.pattern());
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

}  // namespace
}  // namespace breast
