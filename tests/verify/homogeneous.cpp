// SPDX-License-Identifier: GPL-3.0-or-later
// Homogeneous states of every law, element and form of the invariants against closed forms, forward
// and inverted.
#include <gtest/gtest.h>

#include "fixtures/block.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/exact_states.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/laws.hpp"
#include "fixtures/other_inverses.hpp"

namespace breast {
namespace {

constexpr double side = 20;

HexMesh small_block(int order) {
  fixtures::BlockSettings settings;
  settings.elements = {2, 2, 2};
  settings.size = Vec3::Constant(side);
  settings.distortion = 0.1;
  settings.order = order;
  return fixtures::block(settings);
}

bool at_end(double x) {
  return std::abs(x) < 1e-9 || std::abs(x - side) < 1e-9;
}

// The faces x and y move as the state says, z = 0 is a roller, z = side is free.
Constraints sides_held(const HexMesh& mesh) {
  Constraints held(mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i) {
    const Vec3& x = mesh.reference[i];
    NodeConstraint c;
    c.held[0] = c.held[1] = at_end(x.x()) || at_end(x.y());
    c.held[2] = std::abs(x.z()) < 1e-9;
    if (c.held[0] || c.held[2]) held.set(i, c);
  }
  return held;
}

Eigen::VectorXd moved(const HexMesh& mesh, const Mat3& f) {
  Eigen::VectorXd x(3L * mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i) x.segment<3>(3L * i) = f * mesh.reference[i];
  return x;
}

class Homogeneous : public testing::TestWithParam<int> {
 protected:
  HexMesh mesh_ = small_block(GetParam());
  Element element_ = GetParam() == 1 ? Element::q1p0 : Element::q2p1;
};

// Nodal reactions are those of the closed-form stress, at every node and in every direction.
TEST_P(Homogeneous, ForcesAreThoseOfTheClosedForm) {
  for (const Law& law : every_law()) {
    const Scene scene(mesh_, fixtures::options_of(law, element_));
    for (const fixtures::HomogeneousState& exact : fixtures::homogeneous_states()) {
      const Mat3 stress = exact.first_piola(law);
      const Eigen::VectorXd forces =
          fixtures::exact_load(mesh_, [&](const Vec3&) { return stress; });
      const Eigen::VectorXd targets = moved(mesh_, exact.f);
      State state = scene.at_rest(flatten(mesh_.reference));
      const EquilibriumResult result = fixtures::solve_held(
          scene, Eigen::VectorXd::Zero(targets.size()), sides_held(mesh_), targets, state);
      ASSERT_TRUE(result.converged) << exact.name << ", " << law.describe() << result.reason;
      EXPECT_LT((state.x - targets).lpNorm<Eigen::Infinity>(), 1e-8) << exact.name;
      EXPECT_LT((result.forces.r - forces).norm(), 1e-8 * forces.norm())
          << exact.name << ", " << law.describe();
    }
  }
}

// The same states inverted: from the deformed shape and its forces back to the block.
TEST_P(Homogeneous, BackwardFindsTheBlock) {
  for (const Law& law : every_law()) {
    for (const fixtures::HomogeneousState& exact : fixtures::homogeneous_states()) {
      const Mat3 stress = exact.first_piola(law);
      const Eigen::VectorXd forces =
          fixtures::exact_load(mesh_, [&](const Vec3&) { return stress; });
      HexMesh mesh = mesh_;
      mesh.imaged = unflatten(moved(mesh_, exact.f));
      for (int i = 0; i < mesh.nodes(); ++i) {
        if (std::abs(mesh_.reference[i].x()) < 1e-9) continue;  // the wall
        mesh.reference[i] += 0.3 * (mesh.imaged[i] - mesh_.reference[i]);
      }
      const SolveSummary summary =
          fixtures::backward_under_into(mesh, forces, fixtures::options_of(law, element_));
      // Dead forces may leave it unstable; the body is found all the same.
      ASSERT_EQ(summary.load_reached, 1)
          << exact.name << ", " << law.describe() << ": " << summary.record.reason;
      double worst = 0;
      for (int i = 0; i < mesh.nodes(); ++i) {
        worst = std::max(worst, (mesh.reference[i] - mesh_.reference[i]).norm());
      }
      EXPECT_LT(worst, 1e-7) << exact.name << ", " << law.describe();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, Homogeneous, testing::Values(1, 2));

}  // namespace
}  // namespace breast
