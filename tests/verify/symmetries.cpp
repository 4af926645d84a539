// SPDX-License-Identifier: GPL-3.0-or-later
// What must not change a result: rigid motion, the numbering of nodes and elements, mirror images;
// and the two forms of the invariants, whose answers must meet as the mesh is refined.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/laws.hpp"
#include "fixtures/renumbered.hpp"
#include "fixtures/shapes.hpp"
#include "mesh/element_order.hpp"

namespace breast {
namespace {

const Vec3 prone(0, -gravity_mm_s2, 0), oblique(4000, -7000, 3000);

MechanicsOptions paper_options() {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  return options;
}

// Skin, tissues and every law: a turned and moved body carries no force.
TEST(Symmetry, RigidMotionMakesNoForce) {
  for (const HexMesh& mesh :
       {fixtures::cap({.elements = 4}), raise_order(fixtures::cap({.elements = 4}))}) {
    const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    for (const Law& law : every_law()) {
      const Scene scene(mesh,
                        fixtures::options_of(law, mesh.order == 1 ? Element::q1p0 : Element::q2p1));
      State state = scene.at_rest(flatten(mesh.reference));
      for (int i = 0; i < mesh.nodes(); ++i) {
        state.x.segment<3>(3L * i) = turn * mesh.reference[i] + Vec3(300, -200, 100);
      }
      const Forces forces =
          scene.problem(Eigen::VectorXd::Zero(state.x.size())).problem.forces(state);
      ASSERT_TRUE(forces.valid);
      // Forces of order μ h² = 1e5 µN would come from strains of order one.
      EXPECT_LT(forces.r.lpNorm<Eigen::Infinity>(), 1e-5) << law.describe();
      EXPECT_LT(forces.theta.lpNorm<Eigen::Infinity>(), 1e-8);
      EXPECT_NEAR(forces.energy, 0, 1e-4);
    }
  }
}

TEST(Symmetry, NumberingDoesNotMatter) {
  const HexMesh mesh = fixtures::cap({.elements = 6});
  const auto [other, nodes] = fixtures::renumbered(mesh);
  HexMesh a = mesh, b = other;
  ASSERT_TRUE(fixtures::backward_into(a, prone, paper_options()).converged());
  ASSERT_TRUE(fixtures::backward_into(b, prone, paper_options()).converged());
  ASSERT_TRUE(fixtures::forward_into(a, oblique, paper_options()).converged());
  ASSERT_TRUE(fixtures::forward_into(b, oblique, paper_options()).converged());
  for (int i = 0; i < mesh.nodes(); ++i) {
    EXPECT_LT((b.reference[i] - a.reference[nodes[i]]).norm(), 1e-9);
    EXPECT_LT((b.points[i] - a.points[nodes[i]]).norm(), 1e-9);
  }
}

// The right breast of a left one: mirrored mesh and gravity give the mirrored solution.
TEST(Symmetry, MirrorImages) {
  const HexMesh mesh = fixtures::cap({.elements = 6});
  HexMesh other = mesh;
  const auto mirrored = [](const Vec3& x) { return Vec3(-x.x(), x.y(), x.z()); };
  for (Vec3& x : other.imaged) x = mirrored(x);
  other.points = other.reference = other.imaged;
  for (int e = 0; e < mesh.elements(); ++e) {  // ξ backwards keeps the elements right-handed
    for (int a = 0; a < 8; ++a) {
      constexpr int swap[8] = {1, 0, 3, 2, 5, 4, 7, 6};
      other.connectivity[8 * std::size_t(e) + a] = mesh.element(e)[swap[a]];
    }
  }
  for (auto* faces : {&other.skin_faces, &other.pectoral_faces, &other.cut_faces}) {
    for (Face& face : *faces) {
      if (face.local < 2) face.local = 1 - face.local;
    }
  }
  HexMesh a = mesh, b = other;
  ASSERT_TRUE(fixtures::backward_into(a, oblique, paper_options()).converged());
  ASSERT_TRUE(fixtures::backward_into(b, mirrored(oblique), paper_options()).converged());
  for (int i = 0; i < mesh.nodes(); ++i) {
    EXPECT_LT((b.reference[i] - mirrored(a.reference[i])).norm(), 1e-9);
  }
}

// Newton counts of a fixed problem: a change of a kernel, a tangent or the line search shows here.
TEST(Counts, OfABreastUnderGravity) {
  HexMesh mesh = fixtures::cap({.elements = 8});
  const SolveSummary backward = fixtures::backward_into(mesh, prone, paper_options());
  ASSERT_TRUE(backward.converged());
  EXPECT_EQ(backward.steps, 1);
  EXPECT_EQ(backward.newton_iterations, 5);
  const SolveSummary forward = fixtures::forward_into(mesh, -prone, paper_options());
  ASSERT_TRUE(forward.converged());
  EXPECT_EQ(forward.steps, 1);
  EXPECT_EQ(forward.newton_iterations, 6);
  EXPECT_EQ(forward.factorisations, 4);  // the last one serves three steps
}

// Displacement of the corner of a block under gravity, mm.
Vec3 corner(int n, int order, Invariants invariants) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  settings.order = order;
  HexMesh mesh = fixtures::block(settings);
  const MechanicsOptions options =
      fixtures::options_of(every_law()[0], order == 1 ? Element::q1p0 : Element::q2p1, invariants);
  const SolveSummary summary = fixtures::forward_into(mesh, Vec3(0, 0, -gravity_mm_s2), options);
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  const int node = fixtures::node_at(mesh, settings.size);
  return mesh.points[node] - mesh.reference[node];
}

// With law (9) plain invariants lock; both forms still go to one answer.
TEST(Invariants, PlainAndIsochoricMeet) {
  std::vector<double> apart;
  for (const int n : {3, 6, 12}) {
    apart.push_back((corner(n, 1, Invariants::plain) - corner(n, 1, Invariants::isochoric)).norm());
  }
  EXPECT_GT(apart[0] / apart[1], 1.5);
  EXPECT_GT(apart[1] / apart[2], 2);
  std::vector<double> quadratic;
  for (const int n : {2, 4}) {
    quadratic.push_back(
        (corner(n, 2, Invariants::plain) - corner(n, 2, Invariants::isochoric)).norm());
  }
  EXPECT_GT(quadratic[0] / quadratic[1], 2);
  EXPECT_LT(quadratic[1], 0.4 * apart[1]);  // fewer than twice the nodes
  RecordProperty("apart_mm", message(apart[0], " ", apart[1], " ", apart[2], "; 27 nodes ",
                                     quadratic[0], " ", quadratic[1]));
}

}  // namespace
}  // namespace breast
