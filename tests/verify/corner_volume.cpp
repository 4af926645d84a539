// SPDX-License-Identifier: GPL-3.0-or-later
// Corners of elements that resist changes of volume: what they must not change, and what they change.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/shapes.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/terms/corner_volume.hpp"
#include "mesh/nodal.hpp"
#include "mesh/shape.hpp"
#include "solve/problem.hpp"

namespace breast {
namespace {

constexpr double bulk = 20000;  // Pa, 16 times the shear modulus of the law
const Vec3 prone(0, -gravity_mm_s2, 0);

MechanicsOptions options_with(double corner_bulk) {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.materials.laws.fill(Law{"mooney_rivlin", {310, 300}});
  options.materials.corner_bulk.fill(corner_bulk);
  return options;
}

HexMesh cube(int n, double distortion = 0, int order = 1) {
  fixtures::BlockSettings settings;
  settings.order = order;
  settings.elements = {n, n, n};
  settings.distortion = distortion;
  return fixtures::block(settings);
}

// Any deformation that is the same everywhere and keeps volumes, however large, costs nothing in elements of
// any shape.
class CornerVolumeOf : public testing::TestWithParam<Element> {};
TEST_P(CornerVolumeOf, DoesNotResistWhatKeepsVolumes) {
  const HexMesh mesh = GetParam() == Element::q1p0 ? cube(3, 0.2) : cube(3, 0.1, 2);
  MechanicsOptions options = options_with(bulk);
  options.element = GetParam();
  const Scene scene(mesh, options);
  const auto term = make_corner_volume(mesh, options, *scene.solid().space());
  Mat3 f;
  f << 0.4, 0.7, 0, 0, 1.25, 0.3, 0, 0, 2;
  ASSERT_NEAR(f.determinant(), 1, 1e-12);
  State state = scene.at_rest(flatten(mesh.reference));
  for (int n = 0; n < mesh.nodes(); ++n)
    state.x.segment<3>(3L * n) = f * mesh.reference[std::size_t(n)];
  Problem problem(scene.solid().space(), Constraints(mesh.nodes()));
  problem.add(term);
  const Forces forces = problem.evaluate(state, {});
  ASSERT_TRUE(forces.valid);
  EXPECT_LT(forces.r.lpNorm<Eigen::Infinity>(), 1e-6 * bulk);
  EXPECT_LT(forces.energy, 1e-18 * bulk * 1e6);
}

INSTANTIATE_TEST_SUITE_P(Elements, CornerVolumeOf, testing::Values(Element::q1p0, Element::q2p1));

Vec3 moved_corner(int n, double corner_bulk) {
  HexMesh mesh = cube(n);
  const SolveSummary summary =
      fixtures::forward_into(mesh, Vec3(0, 0, -gravity_mm_s2), options_with(corner_bulk));
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  const int node = fixtures::node_at(mesh, Vec3(100, 100, 100));
  return mesh.points[std::size_t(node)] - mesh.reference[std::size_t(node)];
}

// In the limit of small elements the body is incompressible everywhere, and the term has no influence. A block
// that bends by its own length shows it most; the edges at which it is held keep the order at one.
TEST(CornerVolume, ItsInfluenceVanishesWithTheElements) {
  double before = 0;
  for (const int n : {4, 8, 16}) {
    const double influence = (moved_corner(n, bulk) - moved_corner(n, 0)).norm();
    EXPECT_GT(influence, 0) << n;
    if (n > 4) {
      EXPECT_LT(influence, 0.7 * before) << n;
    }
    before = influence;
  }
  EXPECT_LT(before, 0.05 * 88.3);  // of the displacement
}

// A backward solve first lets the corners yield: from the imaged shape it would take short steps.
TEST(CornerVolume, BackwardClosesInFewIterations) {
  HexMesh mesh = fixtures::cap({});
  MechanicsOptions options;
  options.materials = load_materials("invivo");
  options.materials.corner_bulk.fill(4000);  // 125 times the shear modulus of fat
  const Equilibrium back = solve_backward(mesh, prone, options);
  ASSERT_TRUE(back.converged()) << back.record.reason;
  EXPECT_LE(back.newton_iterations, 16);
  mesh.reference = back.reference;
  const Equilibrium forth = solve_forward(mesh, prone, options);
  ASSERT_TRUE(forth.converged()) << forth.record.reason;
  double worst = 0;
  for (int n = 0; n < mesh.nodes(); ++n)
    worst = std::max(worst, (forth.points[std::size_t(n)] - mesh.imaged[std::size_t(n)]).norm());
  EXPECT_LT(worst, 1e-7);
}

HexMesh heavy_cap() {
  fixtures::CapSettings settings;
  settings.elements = 4;
  settings.order = 2;
  settings.base = 190;
  settings.depth = 110;
  settings.with_cut = true;
  return fixtures::cap(settings);
}

MechanicsOptions soft_options() {
  MechanicsOptions options;
  options.element = Element::q2p1;
  options.materials = load_materials("invivo-borders");
  return options;
}

Mat3 jacobian(const HexMesh& mesh, const std::vector<Vec3>& shape_points, int e,
              const HexShape& at) {
  Mat3 sum = Mat3::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a)
    sum += shape_points[std::size_t(mesh.element(e)[a])] * at.gradients.col(a).transpose();
  return sum;
}

// Where the pressure is many times the shear modulus, the middle of an edge between corners that resist would turn
// inside out (beyond 97 % of this load).
TEST(CornerVolume, ElementsOf27NodesStayRegularInAHeavySoftBody) {
  const HexMesh mesh = heavy_cap();
  const MechanicsOptions options = soft_options();
  const Equilibrium back = solve_backward(mesh, 1.5 * prone, options);
  ASSERT_TRUE(back.converged()) << back.record.reason;
  EXPECT_LE(back.newton_iterations, 16);
  double most = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < 27; ++a) {
      const HexShape shape = hex_shape(2, hex_node_local(2, a));
      const double before = jacobian(mesh, back.reference, e, shape).determinant();
      const double after = jacobian(mesh, mesh.imaged, e, shape).determinant();
      ASSERT_GT(before, 0);
      most = std::max(most, std::abs(std::log(after / before)));
    }
  }
  EXPECT_LT(most, 0.5);
}

// The other way from the scan, a heavy soft body starts with a part of the scan's displacement (from rest: 15 iterations).
TEST(CornerVolume, ForwardFromProneToSupineTakesFewIterations) {
  HexMesh mesh = heavy_cap();
  const MechanicsOptions options = soft_options();
  const Equilibrium back = solve_backward(mesh, prone, options);
  ASSERT_TRUE(back.converged()) << back.record.reason;
  mesh.reference = back.reference;
  const Equilibrium supine = solve_forward(mesh, -prone, options);
  ASSERT_TRUE(supine.converged()) << supine.record.reason;
  EXPECT_LE(supine.newton_iterations, 11);
}

// In coarse elements under a heavy load single corners are flattened until they fold, although the elements
// keep their volumes; corners that resist carry the load.
TEST(CornerVolume, KeepsCornersFromFolding) {
  const Vec3 load(-2.6 * gravity_mm_s2, 0, -1.5 * gravity_mm_s2);
  const auto solved = [&](double corner_bulk) {
    HexMesh pressed = cube(2);
    return fixtures::forward_into(pressed, load, options_with(corner_bulk));
  };
  EXPECT_LT(solved(0).load_reached, 0.9);
  const SolveSummary resisting = solved(bulk);
  EXPECT_TRUE(resisting.converged()) << resisting.record.reason;
}

}  // namespace
}  // namespace breast
