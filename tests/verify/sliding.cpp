// SPDX-License-Identifier: GPL-3.0-or-later
// A body that slides on a wall: exact cases, the tangent by differences, limits to a held and to a
// plane wall, and the round trip of forward and backward.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/other_inverses.hpp"
#include "fixtures/sliding_cap.hpp"
#include "mechanics/supports/effects.hpp"
#include "mesh/nodal.hpp"

namespace breast {
namespace {

using fixtures::cap_on_sphere;
using fixtures::slide;
using fixtures::sphere;

const Vec3 prone(0, -gravity_mm_s2, 0), supine(0, gravity_mm_s2, 0);

MechanicsOptions soft(double percent, const fixtures::Wall& wall) {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  scale_materials(options.materials, std::vector<std::string>{message("fat=", percent),
                                                              message("fibroglandular=", percent)});
  options.wall = wall.support, options.wall_surface = wall.surface;
  return options;
}

double worst_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

/// Solves with the nodes that `moved` gives a new place held there; returns the worst distance of
/// all nodes from `expected`.
double slide_rigidly(const HexMesh& mesh, std::shared_ptr<const LevelSurface> surface,
                     const std::function<bool(const Vec3&)>& pulled,
                     const std::function<Vec3(const Vec3&)>& expected, double& det_F) {
  const Scene scene(mesh, soft(100, slide(std::move(surface), 0)));
  LoadedProblem loaded = scene.problem(Eigen::VectorXd::Zero(3L * mesh.nodes()));
  Constraints held(mesh.nodes());
  Eigen::VectorXd targets = flatten(mesh.reference);
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3 x = mesh.reference[std::size_t(node)];
    if (!pulled(x)) continue;
    held.hold(node);
    targets.segment<3>(3L * node) = expected(x);
  }
  loaded.problem.set_constraints(held);
  SaddleMatrix matrix = loaded.problem.make_matrix();
  SaddleSolver solver(loaded.problem.space().pattern);
  State state = scene.at_rest(flatten(mesh.reference));
  const EquilibriumResult result = equilibrate(loaded.problem, solver, matrix, state, {}, &targets);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_LT(result.forces.r.norm(), 1e-8 * scene.stiffness_force());
  det_F = result.forces.min_det_F;
  double worst = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    worst = std::max(
        worst,
        (state.x.segment<3>(3L * node) - expected(mesh.reference[std::size_t(node)])).norm());
  }
  return worst;
}

TEST(Sliding, BlockPulledAlongAPlaneHasNoStress) {
  fixtures::BlockSettings settings;
  settings.elements = {3, 3, 3};
  const HexMesh mesh = fixtures::block(settings);  // on the plane x = 0
  const Vec3 motion(0, 35, -20);
  double det_F = 0;
  EXPECT_LT(slide_rigidly(
                mesh, std::make_shared<fixtures::Plane>(Vec3(1, 0, 0)),
                [](const Vec3& x) { return x.x() > 99; },
                [&](const Vec3& x) -> Vec3 { return x + motion; }, det_F),
            1e-9);
  EXPECT_NEAR(det_F, 1, 1e-12);
}

TEST(Sliding, RingTurnedOnACylinderHasNoStress) {
  fixtures::BlockSettings settings;
  settings.elements = {2, 8, 3};
  settings.size = Vec3(20, 1.2, 40);
  HexMesh mesh = fixtures::block(settings);  // radius 50 to 70, an arc of 1.2 radians
  for (Vec3& p : mesh.imaged) {
    p = Vec3((50 + p.x()) * std::cos(p.y()), (50 + p.x()) * std::sin(p.y()), p.z());
  }
  mesh.points = mesh.reference = mesh.imaged;
  const Mat3 turn = Eigen::AngleAxisd(0.1, Vec3::UnitZ()).toRotationMatrix();
  double det_F = 0;
  EXPECT_LT(slide_rigidly(
                mesh, std::make_shared<fixtures::Cylinder>(50),
                [](const Vec3& x) { return std::hypot(x.x(), x.y()) > 69.9; },
                [&](const Vec3& x) -> Vec3 { return turn * x; }, det_F),
            1e-8);
}

TEST(Sliding, BodyTurnedRigidlyOnASphereFeelsNoForce) {
  const HexMesh mesh = cap_on_sphere();
  const Scene scene(mesh, soft(100, slide(sphere(), 0)));
  const LoadedProblem loaded = scene.problem(Eigen::VectorXd::Zero(3L * mesh.nodes()));
  State state = scene.at_rest(flatten(mesh.reference));
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3 centre(0, 120, 0);
    state.x.segment<3>(3L * node) = centre + turn * (mesh.reference[std::size_t(node)] - centre);
  }
  const Eigen::VectorXd turned = state.x;
  ASSERT_EQ(loaded.problem.restore(state.x), -1);
  EXPECT_LT((state.x - turned).lpNorm<Eigen::Infinity>(), 1e-10);
  const Forces forces = loaded.problem.forces(state);
  EXPECT_LT(forces.r.lpNorm<Eigen::Infinity>(), 1e-8 * scene.stiffness_force());
}

// Along a curve on the wall the second derivative of the energy is that of the tangent with the
// turning of the wall's force in it, at equilibrium or not.
TEST(Sliding, TangentIsTheSecondDerivativeAlongTheWall) {
  const HexMesh mesh = cap_on_sphere(4);
  const Scene scene(mesh, soft(50, slide(sphere(), 0.02)));
  const LoadedProblem loaded = scene.problem(scene.gravity_force(supine));
  State state = scene.at_rest(flatten(mesh.reference));
  for (long i = 0; i < state.x.size(); ++i) state.x[i] += 0.4 * fixtures::noise(int(i));
  for (long i = 0; i < state.p.size(); ++i) state.p[i] += 300 * fixtures::noise(int(i) + 7);
  ASSERT_EQ(loaded.problem.restore(state.x), -1);
  SaddleMatrix matrix = loaded.problem.make_matrix();
  Forces forces;
  Request request;
  request.matrix = &matrix;
  forces = loaded.problem.evaluate(state, request);
  ASSERT_TRUE(forces.valid);
  Eigen::VectorXd along(state.x.size());
  for (long i = 0; i < along.size(); ++i) along[i] = fixtures::noise(int(i) + 31);
  loaded.problem.constraints_at(state.x).project(along);
  const auto energy = [&](double length) {
    State there = state;
    there.x += length * along;
    EXPECT_EQ(loaded.problem.restore(there.x), -1);
    return loaded.problem.forces(there).energy;
  };
  const double h = 2e-3;
  const double differences = (energy(h) - 2 * energy(0) + energy(-h)) / (h * h);
  const double exact = along.dot(matrix.multiply_unaugmented(along));
  EXPECT_NEAR(differences, exact, 1e-4 * std::abs(exact));
  // The turning matters: without it the two differ by twenty times that bound.
  matrix.stiffness.set_zero();
  const SlidingNodes& sliding = *loaded.problem.sliding();
  sliding.add_curvature(state, request, forces);
  EXPECT_GT(std::abs(along.dot(matrix.stiffness.multiply(along))), 2e-3 * std::abs(exact));
}

TEST(Sliding, PlaneWallEqualsRollers) {
  const HexMesh mesh = fixtures::cap({.elements = 6, .with_cut = true});
  const MechanicsOptions options =
      soft(20, slide(std::make_shared<fixtures::Plane>(Vec3(0, -1, 0)), 0.02));
  HexMesh slid = mesh;
  const Equilibrium found = fixtures::forward_into(slid, supine, options);
  ASSERT_TRUE(found.converged()) << found.record.reason;
  const Scene scene(mesh, options);
  LoadedProblem rollers = scene.problem(scene.gravity_force(supine));
  Constraints held(mesh.nodes());
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) held.hold_normal(node, Vec3(0, -1, 0));
  rollers.problem.set_sliding(nullptr);
  rollers.problem.set_constraints(held);
  SaddleMatrix matrix = rollers.problem.make_matrix();
  SaddleSolver solver(rollers.problem.space().pattern);
  State state = scene.at_rest(flatten(mesh.reference));
  ASSERT_TRUE(equilibrate(rollers.problem, solver, matrix, state).converged);
  EXPECT_LT(worst_distance(slid.points, unflatten(state.x)), 1e-9);
  EXPECT_GT(worst_distance(slid.points, mesh.reference), 1);
}

// A block moved by d: the springs pull back each face by its area times their stiffness. The attachment
// pulls the face towards the sternum, or half of each of two faces at 45 degrees, when the block moves
// away from the sternum, with a stiffness that rises over the first millimetre, and does not push it.
TEST(CutSprings, TheAttachmentToTheSternumPullsAndDoesNotPush) {
  constexpr double around = 0.01, sternal = 0.2, size = 60,
                   face = size * size * pascal_per_kilopascal;
  for (const Side side : {Side::left, Side::right}) {
    for (const double degrees : {0.0, 45.0}) {
      fixtures::BlockSettings settings;
      settings.size = Vec3::Constant(size);
      HexMesh mesh = fixtures::block(settings);
      const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Vec3::UnitZ());
      for (Vec3& x : mesh.imaged) x = (turn * x).eval();
      mesh.side = side;
      mesh.cut_faces = boundary_faces(mesh);
      MechanicsOptions options;
      options.cut = cut_support(message("spring:", around, ",", sternal));
      const auto springs = attach_supports(mesh, nullptr, options).springs;
      ASSERT_EQ(springs.size(), 2u);
      options.cut = cut_support(message("spring:", around));
      ASSERT_EQ(attach_supports(mesh, nullptr, options).springs.size(), 1u);
      const double lateral = lateral_sign(side);
      for (const auto& [away, pulled] :
           {std::pair(3.0, 2.5), {1.0, 0.5}, {0.5, 0.125}, {0.0, 0.0}, {-3.0, 0.0}}) {
        const Vec3 moved(away * lateral, -2, 0.5);
        State state{flatten(mesh.imaged), flatten(mesh.imaged), {}};
        for (int node = 0; node < mesh.nodes(); ++node) state.x.segment<3>(3L * node) += moved;
        const Vec3 expected(-sternal * face * pulled * lateral, 0, 0);
        EXPECT_LT((springs[1].term->force_on_body(state) - expected).norm(), 1e-6) << away;
        EXPECT_LT((springs[0].term->force_on_body(state) + 6 * around * face * moved).norm(), 1e-6);
      }
    }
  }
}

// A breast drawn to its side is held by the sternum, and one drawn to the sternum is not.
TEST(CutSprings, TheSternumHoldsABreastThatMovesAwayFromIt) {
  MechanicsOptions loose = soft(20, slide(sphere(), 0.02)), attached = loose;
  loose.cut = cut_support("spring:0.01");
  attached.cut = cut_support("spring:0.01,0.5");
  const auto apart = [&](double lateral) {
    HexMesh free = cap_on_sphere(), held = free;
    const Vec3 gravity(lateral * lateral_sign(free.side), 0, 0);
    EXPECT_TRUE(fixtures::forward_into(free, gravity, loose).converged());
    EXPECT_TRUE(fixtures::forward_into(held, gravity, attached).converged());
    return worst_distance(held.points, free.points);
  };
  EXPECT_GT(apart(5000), 0.1);
  EXPECT_LT(apart(-5000), 0.01 * apart(5000));
}

// A layer that is even everywhere moves along the wall by ρ h g / KT as one piece, wherever it is cut and
// whatever the stiffness there, if the cut carries the weight of what lies beyond; springs alone hold it
// back. Stiff tissue, so that the layer does not shear: by ρ g h² / 2μ = 0.02 mm.
TEST(TissueBeyond, AnEvenLayerMovesAsOneWhereverItIsCut) {
  constexpr double height = 20, along = 0.01, percent = 1e4;
  const Vec3 gravity(0, 6000, -8000);  // along the wall
  const auto moved = [&](const Vec3& size, const std::string& cut) {
    fixtures::BlockSettings settings;
    settings.size = size;
    HexMesh mesh = fixtures::block(settings);
    std::swap(mesh.cut_faces, mesh.skin_faces);
    std::erase_if(mesh.cut_faces, [&](const Face& face) {  // the free surface
      const std::vector<int> nodes = face_nodes(mesh, face);
      return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
        return mesh.imaged[std::size_t(node)].x() > 0.99 * height;
      });
    });
    MechanicsOptions options =
        soft(percent, slide(std::make_shared<fixtures::Plane>(Vec3(1, 0, 0)), along));
    options.cut = cut_support(cut);
    EXPECT_TRUE(fixtures::forward_into(mesh, gravity, options).converged());
    std::vector<Vec3> by;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      by.push_back(mesh.points[i] - mesh.imaged[i]);
    return by;
  };
  const auto furthest_from = [](const std::vector<Vec3>& by, const Vec3& expected) {
    return worst_distance(by, std::vector<Vec3>(by.size(), expected));
  };
  const Vec3 expected = 1e-3 * height / (along * pascal_per_kilopascal) * gravity;
  EXPECT_NEAR(expected.norm(), 20, 1e-9);
  for (const double stiffness : {0.005, 0.1}) {
    for (const Vec3& size : {Vec3(height, 60, 80), Vec3(height, 120, 50)}) {
      EXPECT_LT(furthest_from(moved(size, "tissue:" + format_number(stiffness)), expected), 0.05);
      EXPECT_GT(furthest_from(moved(size, "spring:" + format_number(stiffness)), expected), 2);
    }
  }
}

TEST(TissueBeyond, NeedsAWallThatCarriesIt) {
  HexMesh mesh = cap_on_sphere();
  for (const fixtures::Wall& wall : {fixtures::Wall(), slide(sphere(), 0)}) {
    MechanicsOptions options = soft(20, wall);
    options.cut = cut_support("tissue:0.01");
    EXPECT_THROW(fixtures::forward_into(mesh, supine, options), Error);
  }
}

TEST(Sliding, StiffSupportEqualsAHeldWall) {
  HexMesh slid = cap_on_sphere(), held = slid;
  ASSERT_TRUE(fixtures::forward_into(slid, supine, soft(20, slide(sphere(), 1e4))).converged());
  ASSERT_TRUE(fixtures::forward_into(held, supine, soft(20, {})).converged());
  EXPECT_LT(worst_distance(slid.points, held.points), 0.01);
}

// Springs across the same surface: the stiffer, the nearer to sliding on it exactly.
TEST(Sliding, StiffSpringsAcrossTheSurfaceTendToSliding) {
  HexMesh exact = cap_on_sphere();
  ASSERT_TRUE(fixtures::forward_into(exact, supine, soft(20, slide(sphere(), 0.02))).converged());
  double last = 1e9;
  for (const double across : {1.0, 10.0, 100.0}) {
    HexMesh springs = cap_on_sphere();
    MechanicsOptions options =
        soft(20, {wall_support("spring:" + format_number(across) + ",0.02"), sphere()});
    ASSERT_TRUE(fixtures::backward_into(springs, prone, options).converged());
    HexMesh again = springs;
    ASSERT_TRUE(fixtures::forward_into(again, prone, options).converged());
    EXPECT_LT(worst_distance(again.points, springs.imaged), 1e-8);
    springs.reference = springs.imaged;
    ASSERT_TRUE(fixtures::forward_into(springs, supine, options).converged());
    const double apart = worst_distance(springs.points, exact.points);
    EXPECT_LT(apart, 0.2 * last);
    last = apart;
  }
  EXPECT_LT(last, 0.02);
}

TEST(Sliding, RoundTripClosesAndSlidesFar) {
  for (const double percent : {100.0, 20.0, 10.0}) {
    HexMesh mesh = cap_on_sphere();
    const MechanicsOptions options = soft(percent, slide(sphere(), 0.02));
    const Equilibrium backward = fixtures::backward_into(mesh, prone, options);
    ASSERT_TRUE(backward.converged()) << percent << ": " << backward.record.reason;
    EXPECT_LE(backward.newton_iterations, 15);
    HexMesh again = mesh;
    const Equilibrium forward = fixtures::forward_into(again, prone, options);
    ASSERT_TRUE(forward.converged()) << forward.record.reason;
    EXPECT_LT(worst_distance(again.points, mesh.imaged), 1e-8) << percent;
    const Equilibrium down = fixtures::forward_into(again, supine, options);
    ASSERT_TRUE(down.converged()) << down.record.reason;
    EXPECT_LE(down.newton_iterations, 15);
    EXPECT_TRUE(down.stable);
    double slid = 0, off = 0;
    for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
      const Vec3 centre(0, 120, 0), x = again.points[std::size_t(node)],
                                    imaged = mesh.imaged[std::size_t(node)];
      slid = std::max(slid, (x - imaged).norm());
      off = std::max(off, std::abs((x - centre).norm() - (imaged - centre).norm()));
    }
    EXPECT_GT(slid, 0.5);
    EXPECT_LT(off, 1e-9);
  }
}

TEST(Sliding, FixedPointFindsTheSameStressFreeShape) {
  HexMesh direct = cap_on_sphere(), iterated = direct;
  const MechanicsOptions options = soft(50, slide(sphere(), 0.02));
  ASSERT_TRUE(fixtures::backward_into(direct, prone, options).converged());
  const SolveSummary summary = fixtures::fixed_point_into(iterated, prone, options, 1e-10);
  ASSERT_TRUE(summary.converged()) << summary.record.reason;
  EXPECT_LT(worst_distance(direct.reference, iterated.reference), 1e-8);
}

TEST(Sliding, MultigridEqualsDirect) {
  HexMesh direct = cap_on_sphere(10), multigrid = direct;
  MechanicsOptions options = soft(20, slide(sphere(), 0.02));
  options.solver = SolverOption::direct;
  ASSERT_TRUE(fixtures::backward_into(direct, prone, options).converged());
  ASSERT_TRUE(fixtures::forward_into(direct, supine, options).converged());
  options.solver = SolverOption::multigrid;
  ASSERT_TRUE(fixtures::backward_into(multigrid, prone, options).converged());
  ASSERT_TRUE(fixtures::forward_into(multigrid, supine, options).converged());
  EXPECT_LT(worst_distance(direct.reference, multigrid.reference), 1e-7);
  EXPECT_LT(worst_distance(direct.points, multigrid.points), 1e-7);
}

TEST(Sliding, DoesNotDependOnTheFrame) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(2, -1, 0.5).normalized()).toRotationMatrix();
  HexMesh mesh = cap_on_sphere(), turned = mesh;
  for (std::vector<Vec3>* list : {&turned.imaged, &turned.points, &turned.reference}) {
    for (Vec3& p : *list) p = (turn * p).eval();
  }
  ASSERT_TRUE(fixtures::forward_into(mesh, supine, soft(20, slide(sphere(), 0.02))).converged());
  const auto surface = std::make_shared<fixtures::Turned>(sphere(), turn);
  ASSERT_TRUE(
      fixtures::forward_into(turned, turn * supine, soft(20, slide(surface, 0.02))).converged());
  for (Vec3& p : turned.points) p = (turn.transpose() * p).eval();
  EXPECT_LT(worst_distance(mesh.points, turned.points), 1e-8);
}

// Without springs nothing holds the body against gravity along the wall.
TEST(Sliding, ANodeThatLeavesTheSurfaceIsTheReason) {
  HexMesh mesh = cap_on_sphere(4);
  auto small = sphere();
  small->reach = 90;  // the base ends 78 mm from the front
  const Equilibrium found =
      fixtures::forward_into(mesh, Vec3(gravity_mm_s2, 0, 0), soft(5, slide(small, 0.001)));
  EXPECT_FALSE(found.converged());
  EXPECT_EQ(found.reason_id, "left_wall_surface") << found.record.reason;
}

TEST(Sliding, EstimateIsOfTheRightSize) {
  MechanicsOptions options = soft(50, slide(sphere(), 0.02));
  options.estimate = Estimate::step;
  HexMesh coarse = cap_on_sphere(6), fine = cap_on_sphere(18);
  const Equilibrium found = fixtures::forward_into(coarse, supine, options);
  ASSERT_TRUE(found.converged());
  ASSERT_GT(found.error_estimate_mm, 0);
  options.estimate = Estimate::none;
  ASSERT_TRUE(fixtures::forward_into(fine, supine, options).converged());
  const auto place = [](const HexMesh& mesh) {
    const Landmark& nipple = *mesh.landmark("nipple");
    return landmark_position(mesh, mesh.points, nipple);
  };
  const Vec3 error = place(fine) - place(coarse);
  EXPECT_LT((found.landmark_error_mm.at("nipple") - error).norm(), 0.5 * error.norm() + 0.05);
}

}  // namespace
}  // namespace breast
