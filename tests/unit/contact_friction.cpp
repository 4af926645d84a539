// SPDX-License-Identifier: GPL-3.0-or-later
// Friction's return map, the springs of an elastic wall, and the options that name them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "contact/options.hpp"
#include "contact/terms/friction.hpp"
#include "core/error.hpp"
#include "fixtures/standing_block.hpp"
#include "mechanics/terms/elastic_support.hpp"
#include "mesh/nodal.hpp"

using namespace breast;

TEST(Friction, SticksBelowTheBoundAndSlipsOnIt) {
  const Friction friction{0.3, 3e-4};
  const Vec3 anchor(1, 2, 3), normal = Vec3(1, 2, -2).normalized();
  const Vec3 along = normal.unitOrthogonal();
  const auto at = [&](const Vec3& x, const Vec3& from, double bound) {
    return friction_force(x, from, normal, bound, friction.stick(bound));
  };
  const FrictionForce sticks = at(anchor + 1e-4 * along + 5 * normal, anchor, 300);
  EXPECT_FALSE(sticks.slips);
  EXPECT_LT((sticks.force + 100 * along).norm(), 1e-9);
  const FrictionForce slips = at(anchor + 1e-2 * along, anchor, friction.bound(1e3));
  EXPECT_TRUE(slips.slips);
  EXPECT_LT((slips.force + 300 * along).norm(), 1e-9);
  // After the slip the anchor lies where the spring holds exactly the bound.
  const Vec3 slid = anchor + 1e-2 * along + slips.force / friction.stick(300);
  EXPECT_LT((at(anchor + 1e-2 * along, slid, 300).force - slips.force).norm(), 1e-6);
  EXPECT_EQ(at(anchor + along, anchor, friction.bound(-5)).force, Vec3(0, 0, 0));
}

TEST(ElasticSupport, ForceIsStiffnessTimesAreaTimesMotion) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {2, 2, 2});  // wall y = 0: 2000 mm²
  const ElasticSupport wall(mesh, mesh.pectoral_faces, {0.5, 0.2});
  const auto pushed = [&](const Vec3& by) {
    std::vector<Vec3> x = mesh.reference;
    for (Vec3& point : x) point += by;
    return wall.force_on_body({flatten(mesh.reference), flatten(x), {}});
  };
  // 0.5 kPa/mm · 2000 mm² = 1e6 µN/mm across the wall.
  EXPECT_LT((pushed({0, 2, 0}) - Vec3(0, -2e6, 0)).norm(), 1e-3);
  EXPECT_LT((pushed({1, 0, 3}) - Vec3(-0.4e6, 0, -1.2e6)).norm(), 1e-3);
  EXPECT_THROW(ElasticSupport(mesh, mesh.pectoral_faces, {0, 1}), Error);
  EXPECT_THROW(ElasticSupport(mesh, mesh.pectoral_faces, {1, std::nan("")}), Error);
}

TEST(ContactOptions, WallAndDetectorAreReadOrRefusedInWords) {
  EXPECT_EQ(parse_wall("held").kind, WallKind::held);
  EXPECT_EQ(parse_wall("fixed").kind, WallKind::held);
  EXPECT_EQ(parse_wall("slide").stiffness.tangential, usual_sliding_stiffness);
  EXPECT_EQ(parse_wall("slide:0").kind, WallKind::slide);
  EXPECT_EQ(parse_wall("slide:0.02").stiffness.tangential, 0.02);
  EXPECT_NEAR(parse_wall("spring:3").stiffness.tangential, 1, 1e-15);
  EXPECT_EQ(parse_wall("spring:3,0").stiffness.tangential, 0);
  EXPECT_EQ(parse_cut("roller").kind, Cut::roller);
  EXPECT_EQ(parse_cut("spring:0.005").stiffness, 0.005);
  EXPECT_FALSE(parse_cut("spring:0.005").sternal);
  EXPECT_EQ(parse_cut("spring:0.005,0.1").sternal, 0.1);
  for (const char* text : {"held", "slide:0.02", "spring:3,0.5"}) {
    EXPECT_EQ(describe(parse_wall(text)), text);
  }
  for (const char* text :
       {"free", "fixed", "roller", "spring:0.005", "spring:0.005,0.1", "tissue:0.005,0.1"}) {
    EXPECT_EQ(describe(parse_cut(text)), text);
  }
  EXPECT_TRUE(std::isinf(parse_detector("raised")));
  EXPECT_EQ(parse_detector("fixed"), 0);
  EXPECT_EQ(parse_detector("12.5"), 12.5);
  for (const char* bad : {"", "spring", "spring:", "spring:0", "spring:-1", "spring:1,-1",
                          "spring:1,", "spring:nan", "spring:1;2", "spring:1,2,3", "free", "slide:", "slide:-1",
                          "slide:1,1"}) {
    EXPECT_THROW(parse_wall(bad), Error) << bad;
  }
  for (const char* bad : {"", "held", "spring", "spring:0", "spring:-1", "spring:1,0", "spring:1,", "spring:1,1,1"}) {
    EXPECT_THROW(parse_cut(bad), Error) << bad;
  }
  for (const char* bad : {"", "-1", "nan", "inf", "up", "3mm"}) {
    EXPECT_THROW(parse_detector(bad), Error) << bad;
  }
}
