// SPDX-License-Identifier: GPL-3.0-or-later
// Gravity: the block other programs solved, and the round trip of forward and backward.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/other_inverses.hpp"
#include "fixtures/shapes.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/turn.hpp"
#include "mesh/element_order.hpp"

namespace breast {
namespace {

using fixtures::CapSettings;

MechanicsOptions paper_options() {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  return options;
}

MechanicsOptions one_law(const Law& law) {
  MechanicsOptions options = paper_options();
  for (Law& each : options.materials.laws) each = law;
  return options;
}

const Law mooney{"mooney_rivlin", {310, 300}};
const Law fat{"polynomial", {310, 300, 2250, 3800, 4720}};
const Vec3 prone(0, -gravity_mm_s2, 0);

double worst_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

// Displacement of the corner (100, 100, 100) of a 0.1 m cube clamped at x = 0, gravity along −z.
Vec3 corner(int n, const MechanicsOptions& options, int* iterations = nullptr) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  HexMesh mesh = fixtures::block(settings);
  const SolveSummary summary = fixtures::forward_into(mesh, Vec3(0, 0, -gravity_mm_s2), options);
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  if (iterations != nullptr) *iterations = summary.newton_iterations;
  const int node = fixtures::node_at(mesh, Vec3(100, 100, 100));
  return mesh.points[node] - mesh.reference[node];
}

// deal.II's step-44 and FEBio's three-field element, n = 8 and 16, bulk/shear = 1000, agree to
// these digits.
TEST(GravityBlock, AgreesWithOtherPrograms) {
  MechanicsOptions options = one_law(mooney);
  options.bulk_ratio = 1000;
  EXPECT_LT((corner(8, options) - Vec3(12.278, -0.4015, -88.407)).norm(), 1e-3);
  options = one_law(fat);
  options.bulk_ratio = 1000;
  EXPECT_LT((corner(8, options) - Vec3(6.7249, -0.2333, -27.366)).norm(), 1e-3);
  EXPECT_LT((corner(16, options) - Vec3(6.6703, -0.2052, -27.730)).norm(), 1e-3);
}

// Their limit for growing bulk modulus: −88.323 mm.
TEST(GravityBlock, ExactlyIncompressible) {
  int iterations = 0;
  EXPECT_NEAR(corner(8, one_law(mooney), &iterations).z(), -88.323, 6e-4);
  EXPECT_LE(iterations, 8);
}

// Law (9) with plain invariants is stiff against volume pointwise and locks:
// −24.79 against −27.37 mm.
TEST(GravityBlock, PlainInvariantsLock) {
  MechanicsOptions options = one_law(fat);
  options.invariants = Invariants::plain;
  EXPECT_NEAR(corner(8, options).z(), -24.79, 0.02);
  EXPECT_LT(corner(8, one_law(fat)).z(), -27.3);
}

struct RoundTrip {
  double closure = 0;
  int backward = 0, forward = 0;
};
RoundTrip round_trip(HexMesh mesh, const MechanicsOptions& options, const Vec3& gravity = prone) {
  RoundTrip result;
  SolveSummary summary = fixtures::backward_into(mesh, gravity, options);
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  EXPECT_TRUE(summary.stable);
  EXPECT_LT(summary.max_volume_error, options.bulk_ratio > 0 ? 0.1 : 1e-9);
  result.backward = summary.newton_iterations;
  EXPECT_GT(worst_distance(mesh.reference, mesh.imaged), 0.01);  // it did move
  summary = fixtures::forward_into(mesh, gravity, options);
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  result.forward = summary.newton_iterations;
  result.closure = worst_distance(mesh.points, mesh.imaged);
  return result;
}

TEST(RoundTrip, ClosesToRounding) {
  const RoundTrip trip = round_trip(fixtures::cap({.elements = 8}), paper_options());
  EXPECT_LT(trip.closure, 1e-8);
  EXPECT_LE(trip.backward, 7);
  EXPECT_LE(trip.forward, 7);
}

TEST(RoundTrip, ClosesForEveryOption) {
  const HexMesh plain_mesh = fixtures::cap({.elements = 4, .skin_mm = 0});
  const HexMesh skin_mesh = fixtures::cap({.elements = 4});
  MechanicsOptions options = paper_options();
  EXPECT_LT(round_trip(plain_mesh, options).closure, 1e-8);
  options.invariants = Invariants::plain;
  EXPECT_LT(round_trip(skin_mesh, options).closure, 1e-8);
  options = paper_options();
  options.bulk_ratio = 200;
  EXPECT_LT(round_trip(skin_mesh, options).closure, 1e-8);
  options = paper_options();
  options.element = Element::q2p1;
  EXPECT_LT(round_trip(raise_order(skin_mesh), options).closure, 1e-8);
  for (const char* cut : {"free", "fixed", "roller"}) {
    options = paper_options();
    options.cut = cut_support(cut);
    EXPECT_LT(round_trip(fixtures::cap({.elements = 6, .with_cut = true}), options).closure, 1e-8);
  }
  for (const std::string set : {"wellman", "victre"}) {
    options = paper_options();
    options.materials = load_materials(set);
    EXPECT_LT(round_trip(skin_mesh, options).closure, 1e-8) << set;
  }
}

TEST(RoundTrip, RollerHoldsOnlyTheNormal) {
  HexMesh mesh = fixtures::cap({.elements = 6, .with_cut = true});
  ASSERT_FALSE(mesh.cut_faces.empty());
  std::vector<double> nipple;
  for (const char* cut : {"free", "roller", "fixed"}) {
    MechanicsOptions options = paper_options();
    options.cut = cut_support(cut);
    HexMesh solved = mesh;
    ASSERT_TRUE(fixtures::forward_into(solved, prone, options).converged());
    nipple.push_back((landmark_position(solved, solved.points, *solved.landmark("nipple")) -
                      landmark_position(solved, solved.reference, *solved.landmark("nipple")))
                         .norm());
  }
  EXPECT_GT(nipple[0], nipple[1]);
  EXPECT_GT(nipple[1], nipple[2]);
}

TEST(Backward, FixedPointFindsTheSameShape) {
  HexMesh direct = fixtures::cap({.elements = 6}), iterated = direct;
  ASSERT_TRUE(fixtures::backward_into(direct, prone, paper_options()).converged());
  const SolveSummary summary = fixtures::fixed_point_into(iterated, prone, paper_options(), 1e-10);
  ASSERT_TRUE(summary.converged()) << summary.record.reason;
  EXPECT_GE(summary.steps, 5);
  EXPECT_LT(worst_distance(direct.reference, iterated.reference), 1e-8);
}

TEST(Backward, NoGravityMovesNothing) {
  HexMesh mesh = fixtures::cap({.elements = 4});
  const SolveSummary summary = fixtures::backward_into(mesh, Vec3::Zero(), paper_options());
  EXPECT_TRUE(summary.converged());
  EXPECT_LT(worst_distance(mesh.reference, mesh.imaged), 1e-10);
}

// At rest already: no step, and nothing to doubt.
TEST(Forward, NoGravityMovesNothing) {
  HexMesh mesh = fixtures::cap({.elements = 4});
  for (const SolverOption solver : {SolverOption::direct, SolverOption::multigrid}) {
    MechanicsOptions options = paper_options();
    options.solver = solver;
    const SolveSummary summary = fixtures::forward_into(mesh, Vec3::Zero(), options);
    EXPECT_TRUE(summary.converged());
    EXPECT_TRUE(summary.doubts.empty()) << summary.doubts.front();
    EXPECT_LT(worst_distance(mesh.points, mesh.imaged), 1e-10);
  }
}

// Mesh and gravity turned together: the solution turns with them.
TEST(Forward, IsFrameIndifferent) {
  const Mat3 turn = Eigen::AngleAxisd(0.9, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  HexMesh mesh = fixtures::cap({.elements = 4}), turned = mesh;
  for (auto* field : {&turned.imaged, &turned.reference, &turned.points}) {
    for (Vec3& x : *field) x = turn * x;
  }
  ASSERT_TRUE(fixtures::forward_into(mesh, prone, paper_options()).converged());
  ASSERT_TRUE(fixtures::forward_into(turned, turn * prone, paper_options()).converged());
  for (Vec3& x : mesh.points) x = turn * x;
  EXPECT_LT(worst_distance(mesh.points, turned.points), 1e-9);
}

TEST(Forward, DoesNotDependOnTheNumberOfThreads) {
  HexMesh one = fixtures::cap({.elements = 6}), two = one;
  const int before = threads();
  set_threads(1);
  ASSERT_TRUE(fixtures::forward_into(one, prone, paper_options()).converged());
  set_threads(2);
  ASSERT_TRUE(fixtures::forward_into(two, prone, paper_options()).converged());
  set_threads(before);
  EXPECT_LT(worst_distance(one.points, two.points), 1e-10);
}

TEST(Turn, PassesTheSideOfTheBreastBetweenOppositeDirections) {
  const Vec3 supine = -prone;
  for (const Side side : {Side::left, Side::right}) {
    const Vec3 half = turned_gravity(prone, supine, side, 0.5);
    EXPECT_LT((half - Vec3(lateral_sign(side) * gravity_mm_s2, 0, 0)).norm(), 1e-9);
  }
  EXPECT_EQ(turned_gravity(prone, supine, Side::left, 0), prone);
  EXPECT_EQ(turned_gravity(prone, supine, Side::left, 1), supine);
  const Vec3 upright(0, 0, -gravity_mm_s2),
      third = turned_gravity(prone, upright, Side::left, 1 / 3.);
  EXPECT_NEAR(third.dot(prone), std::cos(M_PI / 6) * prone.squaredNorm(), 1e-3);
  EXPECT_NEAR(third.norm(), gravity_mm_s2, 1e-9);
  EXPECT_EQ(turned_gravity(upright, -upright, Side::left, 0.5).normalized().x(), 1);
  EXPECT_EQ(turned_gravity(Vec3::Zero(), prone, Side::left, 0.25), Vec3(0.25 * prone));
  const Vec3 along(lateral_sign(Side::left) * gravity_mm_s2, 0, 0);
  EXPECT_LT((turned_gravity(along, -along, Side::left, 0.5) - supine).norm(), 1e-9);
}

// A square block on its wall, which looks the same after a quarter turn: where gravity has made the
// turn, so has the shape, and half-way it is its own mirror image.
TEST(Turn, OfASquareBlockTurnsItsShape) {
  fixtures::BlockSettings settings;
  settings.elements = {3, 4, 4};
  settings.size = Vec3(60, 60, 60);
  const HexMesh mesh = fixtures::block(settings);
  const Vec3 down(0, 0, -gravity_mm_s2), centre(0, 30, 30);
  const std::vector<Equilibrium> states = solve_turn(mesh, prone, down, 5, one_law(fat));
  ASSERT_EQ(states.size(), 5u);
  const Mat3 quarter = Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()).toRotationMatrix();
  Mat3 mirror = Mat3::Identity();
  std::swap(mirror(1, 1), mirror(1, 2));
  std::swap(mirror(2, 2), mirror(2, 1));
  EXPECT_LT((quarter * prone - down).norm(), 1e-9);
  double moved = 0, off_turned = 0, off_mirrored = 0;
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vec3 at = mesh.imaged[n] - centre;
    const auto partner = [&](const Mat3& q) {
      return std::size_t(fixtures::node_at(mesh, q * at + centre));
    };
    const auto from_centre = [&](int state, std::size_t node) -> Vec3 {
      return states[std::size_t(state)].points[node] - centre;
    };
    off_turned = std::max(
        off_turned,
        (from_centre(4, partner(quarter)) - quarter * from_centre(0, std::size_t(n))).norm());
    off_mirrored = std::max(
        off_mirrored,
        (from_centre(2, partner(mirror)) - mirror * from_centre(2, std::size_t(n))).norm());
    moved =
        std::max(moved, (from_centre(4, std::size_t(n)) - from_centre(0, std::size_t(n))).norm());
  }
  EXPECT_GT(moved, 10);
  EXPECT_LT(off_turned, 1e-7);
  EXPECT_LT(off_mirrored, 1e-7);
  for (const Equilibrium& state : states) {
    EXPECT_TRUE(state.converged());
    EXPECT_LT(state.residual, 1e-9);
    EXPECT_GT(state.newton_iterations, 0);
  }
}

// Each state is what forward finds under its gravity, whatever came before it.
TEST(Turn, StatesAreThoseOfForward) {
  const HexMesh mesh = fixtures::cap({.elements = 4});
  const std::vector<Equilibrium> states = solve_turn(mesh, prone, -prone, 3, paper_options());
  for (int k = 0; k < 3; ++k) {
    const Equilibrium alone =
        solve_forward(mesh, turned_gravity(prone, -prone, mesh.side, 0.5 * k), paper_options());
    ASSERT_TRUE(alone.converged());
    EXPECT_LT(worst_distance(alone.points, states[std::size_t(k)].points), 1e-7) << k;
  }
  EXPECT_THROW(solve_turn(mesh, prone, -prone, 1, paper_options()), Error);
}

}  // namespace
}  // namespace breast
