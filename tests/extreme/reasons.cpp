// SPDX-License-Identifier: GPL-3.0-or-later
// Every reason for having no answer is said by name, and is true.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/shapes.hpp"

namespace breast {
namespace {

const Vec3 prone(0, -gravity_mm_s2, 0);

MechanicsOptions neo_hookean(double a10) {
  return fixtures::options_of({"neo_hookean", {a10}});
}

double closure(HexMesh mesh, const Vec3& gravity, const MechanicsOptions& options) {
  EXPECT_TRUE(fixtures::backward_into(mesh, gravity, options).converged());
  EXPECT_TRUE(fixtures::forward_into(mesh, gravity, options).converged());
  double worst = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    worst = std::max(worst, (mesh.points[i] - mesh.imaged[i]).norm());
  }
  return worst;
}

// A cap too soft to hang in this shape: shapes of ever less load exist, up to a part of it that is
// proportional to the stiffness; the stiffness asked for is enough, a little less is not.
TEST(Reason, NoStressFreeBody) {
  const HexMesh cap = fixtures::cap({.elements = 4, .skin_mm = 0});
  std::vector<double> reached;
  double needed = 0;
  for (const double a10 : {10.0, 5.0}) {
    HexMesh mesh = cap;
    const SolveSummary summary = fixtures::backward_into(mesh, prone, neo_hookean(a10));
    EXPECT_EQ(summary.record.status, SolveStatus::not_converged);
    EXPECT_EQ(summary.reason_id, "no_stress_free_body") << summary.record.reason;
    ASSERT_GT(summary.stiffness_factor_needed, 1);
    reached.push_back(summary.load_reached);
    needed = a10 * summary.stiffness_factor_needed;
    for (const Vec3& x : mesh.reference) EXPECT_TRUE(x.allFinite());
  }
  EXPECT_NEAR(reached[0] / reached[1], 2, 0.25);
  HexMesh mesh = cap;
  EXPECT_TRUE(fixtures::backward_into(mesh, prone, neo_hookean(1.02 * needed)).converged());
  EXPECT_LT(closure(cap, prone, neo_hookean(2 * needed)), 1e-7);
  mesh = cap;
  EXPECT_FALSE(fixtures::backward_into(mesh, prone, neo_hookean(0.8 * needed)).converged());
}

// A column stands under its own weight up to (7.837 EI/w)^(1/3) (Greenhill 1881). The straight body
// exists either way.
HexMesh column(int across) {
  fixtures::BlockSettings settings;
  settings.elements = {4 * across, across, across};
  settings.size = Vec3(120, 20, 20);
  return fixtures::block(settings);
}

const Vec3 down(-gravity_mm_s2, 0, 0);  // towards the column's held foot

// Young's modulus below which it does not stand, Pa.
double critical_modulus() {
  const double inertia = std::pow(20, 4) / 12, weight = 1e-3 * gravity_mm_s2 * 400;  // per mm
  return weight * std::pow(120, 3) / (7.837 * inertia);
}

TEST(Reason, UnstableEquilibrium) {
  const double critical = critical_modulus();
  EXPECT_LT(closure(column(2), down, neo_hookean(2 * critical / 6)), 1e-7);
  HexMesh mesh = column(2);
  const SolveSummary summary =
      fixtures::backward_into(mesh, down, neo_hookean(0.25 * critical / 6));
  EXPECT_EQ(summary.record.status, SolveStatus::unstable);
  EXPECT_EQ(summary.reason_id, "unstable_equilibrium");
  EXPECT_FALSE(summary.stable);
  EXPECT_LT(summary.residual, 1e-9);
  EXPECT_NEAR(summary.stiffness_factor_needed, 4, 1.3);  // two elements across are too stiff
}

// Forward of the straight column finds it standing straight, where it would not stay.
TEST(Reason, ForwardRefusesAnUnstableEquilibrium) {
  const double critical = critical_modulus();
  HexMesh mesh = column(2);
  EXPECT_TRUE(fixtures::forward_into(mesh, down, neo_hookean(2 * critical / 6)).converged());
  mesh = column(2);
  const SolveSummary summary = fixtures::forward_into(mesh, down, neo_hookean(0.5 * critical / 6));
  EXPECT_EQ(summary.record.status, SolveStatus::unstable);
  EXPECT_EQ(summary.reason_id, "unstable_equilibrium") << summary.record.reason;
  EXPECT_FALSE(summary.stable);
  ASSERT_TRUE(summary.remedy);
  EXPECT_EQ(summary.remedy->what, "tissue");
  EXPECT_NEAR(summary.remedy->factor, 2, 0.7);
  EXPECT_FALSE(summary.skin_share.value_or(0) > 0);
}

// The same with a mesh that multigrid is chosen for: it keeps what stands well, and leaves what
// falls or hardly stands to a factor. By itself it knows a tenth above the limit of the mesh from a
// tenth below.
TEST(Reason, MultigridSeesTheUnstableEquilibrium) {
  const HexMesh fine = column(8);
  const auto solved = [&](double modulus, SolverOption solver) {
    HexMesh mesh = fine;
    MechanicsOptions options = neo_hookean(modulus / 6);
    options.solver = solver;
    return fixtures::backward_into(mesh, down, options);
  };
  const SolveSummary falls = solved(0.25 * critical_modulus(), SolverOption::direct);
  ASSERT_EQ(falls.reason_id, "unstable_equilibrium");
  // Found to a tenth, from above.
  const double limit = 0.25 * critical_modulus() * falls.stiffness_factor_needed;
  EXPECT_EQ(solved(2 * limit, SolverOption::automatic).linear_solver, "multigrid");
  for (const SolverOption solver : {SolverOption::automatic, SolverOption::multigrid}) {
    const SolveSummary above = solved(1.1 * limit, solver), below = solved(0.8 * limit, solver);
    EXPECT_TRUE(above.converged()) << above.record.reason;
    EXPECT_EQ(below.reason_id, "unstable_equilibrium");
    EXPECT_EQ(below.linear_solver, solver == SolverOption::automatic ? "direct" : "multigrid");
  }
}

TEST(Reason, IterationLimitAndFolding) {
  const HexMesh mesh = fixtures::cap({.elements = 4});
  const Scene scene(mesh, neo_hookean(600));
  const Problem problem = scene.problem(scene.gravity_force(prone)).problem;
  SaddleMatrix matrix = problem.make_matrix();
  SaddleSolver solver(problem.space().pattern);
  State state = scene.at_rest(flatten(mesh.reference));
  NewtonResult result = equilibrate(problem, solver, matrix, state, {.max_iterations = 2});
  EXPECT_FALSE(result.converged);
  EXPECT_STREQ(stop_name(result.stop), "iteration_limit");
  state.x.segment<3>(3L * mesh.element(0)[0]).swap(state.x.segment<3>(3L * mesh.element(0)[6]));
  result = equilibrate(problem, solver, matrix, state);
  EXPECT_STREQ(stop_name(result.stop), "folded_element");
}

// Forward under a load the discrete body cannot carry: a reason by name, the part of the load that
// it carried, and a finite state.
TEST(Reason, ForwardBeyondWhatTheMeshCarries) {
  HexMesh mesh = fixtures::cap({.elements = 4});
  const SolveSummary summary = fixtures::forward_into(mesh, 3000 * prone, neo_hookean(40));
  ASSERT_FALSE(summary.converged());
  EXPECT_TRUE(summary.reason_id == "iteration_limit" || summary.reason_id == "no_admissible_step" ||
              summary.reason_id == "indefinite_tangent")
      << summary.reason_id;
  EXPECT_LT(summary.load_reached, 1);
  for (const Vec3& x : mesh.points) EXPECT_TRUE(x.allFinite());
}

}  // namespace
}  // namespace breast
