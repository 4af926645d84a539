// SPDX-License-Identifier: GPL-3.0-or-later
// A hand that brings the breast between the plates, and a breast that touches itself or the thorax.
#include "contact/path/positioning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/compressed_shape.hpp"
#include "contact/path/target.hpp"
#include "core/error.hpp"
#include "fixtures/block.hpp"
#include "fixtures/standing_block.hpp"
#include "mesh/nodal.hpp"

namespace breast {
namespace {

TEST(Positioning, TheHandLetsGoOfTheWeightFirst) {
  const Hand hand;
  EXPECT_EQ(hand.weight.at(0), 0);
  EXPECT_EQ(hand.weight.at(0.5), 1);
  EXPECT_NEAR(hand.weight.at(0.3), 0.5, 1e-12);
  EXPECT_EQ(hand.pull.at(0.5), 0);
  EXPECT_EQ(hand.pull.at(0.8), 1);
  EXPECT_EQ(hand.gone_from(), 0.8);
}

// The way to the nearest target: a force that comes early leads, whatever the thickness is. Half of the closing beside a force is an
// eighth of the way, and half of it alone is half of the way.
TEST(Positioning, TheWayIsThatToTheNearestTarget) {
  const CompressionTarget target{
      TargetKind::force, 100, {{TargetKind::thickness, 40}, {TargetKind::pressure, 100, {}, 50}}};
  PathPoint here{90, 60, 60, 0, 0};
  EXPECT_NEAR(part_of_way(here, target, 140), 0.6, 1e-12);
  here.paddle_N = 10;
  EXPECT_NEAR(part_of_way(here, target, 140), 0.125, 1e-12);
  // 10 N on a point of 0.1 cm2 are 1000 kPa, but 2 kPa over the least area.
  here.area_cm2 = 0.1;
  here.pressure_kPa = 1000;
  EXPECT_NEAR(part_of_way(here, target, 140), 0.125, 1e-12);
  const PathPoint before{100, 4, 4, 0, 0};
  EXPECT_NEAR(expected_part_of_way(80, here, &before, target, 140), 0.216, 1e-12);
  EXPECT_NEAR(expected_part_of_way(80, {90, 60, 60, 0, 0}, &before, target, 140), 1.16, 1e-12);
  EXPECT_NEAR(closing_at(0.125, target), 0.5, 1e-12);
  const CompressionTarget thickness{TargetKind::thickness, 40};
  EXPECT_NEAR(part_of_way(here, thickness, 140), 0.5, 1e-12);
  EXPECT_EQ(closing_at(0.5, thickness), 0.5);
}

TEST(Positioning, PullActsForwardsInFrontOfTheEdgeAlone) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = 20;
  const Eigen::VectorXd force = pull_forwards(mesh, mesh.points, plate, 12);
  Vec3 total = Vec3::Zero();
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3 own = force.segment<3>(3L * node);
    total += own;
    const bool behind = mesh.points[std::size_t(node)].dot(plate.anterior) <= 20;
    EXPECT_TRUE(!behind || own.isZero(0)) << node;
  }
  EXPECT_NEAR(total.dot(plate.anterior), 12e6, 1e-3);
  EXPECT_NEAR((total - total.dot(plate.anterior) * plate.anterior).norm(), 0, 1e-3);
  plate.edge_start = 100;
  EXPECT_THROW(pull_forwards(mesh, mesh.points, plate, 12), Error);
}

TEST(Positioning, AStageSaysHowFarTissuePassedTheEdge) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = 20;
  const Eigen::VectorXd upright = flatten(mesh.points);
  std::vector<Vec3> moved = mesh.points;
  for (Vec3& x : moved) x += 10 * plate.anterior + 3 * plate.n;
  const PositioningStage stage = positioning_stage("pulled", mesh, upright, flatten(moved), plate);
  EXPECT_NEAR(stage.past_edge_mm, 10, 1e-12);
  EXPECT_NEAR(stage.volume_in_front_percent, 100 * 50.0 / 60, 1e-9);
}

/// A bar bent to a ring that closes but for `open` of a full turn.
HexMesh bent_bar(double open) {
  HexMesh mesh = fixtures::block({.elements = {24, 1, 1}, .size = {120, 8, 8}});
  for (Vec3& x : mesh.points) {
    const double angle = 2 * std::numbers::pi * (1 - open) * x.x() / 120, radius = 20 - x.y();
    x = {radius * std::sin(angle), -radius * std::cos(angle), x.z()};
  }
  return mesh;
}

TEST(SelfContact, IsSeenWhereEndsMeetAndNowhereElse) {
  EXPECT_EQ(self_contact(bent_bar(0.1), bent_bar(0.1).points).itself_cm2, 0);
  // Ends 0.3 mm apart at the middle, and ends inside one another: one of them is the chest wall's
  // face and is not asked, the other has 0.64 cm².
  EXPECT_GT(self_contact(bent_bar(0.0025), bent_bar(0.0025).points).itself_cm2, 0.3);
  EXPECT_GT(self_contact(bent_bar(-0.02), bent_bar(-0.02).points).itself_cm2, 0.6);
}

}  // namespace
}  // namespace breast
