// SPDX-License-Identifier: GPL-3.0-or-later
// Friction's return map, and the options of contact.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "contact/options.hpp"
#include "contact/terms/friction.hpp"
#include "core/error.hpp"

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

TEST(ContactOptions, DetectorIsReadOrRefusedInWords) {
  EXPECT_TRUE(std::isinf(parse_detector("raised")));
  EXPECT_EQ(parse_detector("fixed"), 0);
  EXPECT_EQ(parse_detector("12.5"), 12.5);
  for (const char* bad : {"", "-1", "nan", "inf", "up", "3mm"}) {
    EXPECT_THROW(parse_detector(bad), Error) << bad;
  }
}
