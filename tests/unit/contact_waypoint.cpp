// SPDX-License-Identifier: GPL-3.0-or-later
// The initial state at the next position of the plates.
#include <gtest/gtest.h>

#include "contact/path/waypoint.hpp"

namespace breast {
namespace {

using Eigen::VectorXd;

Waypoint waypoint(double thickness, double x, std::vector<signed char> touching,
                  std::vector<double> bounds) {
  Waypoint point;
  point.thickness = thickness;
  point.state = {VectorXd::Zero(3), VectorXd::Constant(3, x), VectorXd::Constant(1, 10 * x)};
  point.moved = point.state;
  point.memory.touching = std::move(touching);
  point.memory.bounds = std::move(bounds);
  point.memory.penalty = 7;
  return point;
}

TEST(Extrapolate, IsTheStateItselfWithoutAnother) {
  const Waypoint here = waypoint(50, 3, {0}, {5});
  const Guess guess = extrapolate(here, nullptr, 40);
  EXPECT_EQ(guess.state.x, here.state.x);
  EXPECT_EQ(guess.state.p, here.state.p);
  EXPECT_EQ(guess.memory.bounds, here.memory.bounds);
}

TEST(Extrapolate, GoesOnAsThePlatesMoved) {
  const Waypoint before = waypoint(60, 1, {0}, {5}), here = waypoint(50, 3, {0}, {9});
  const Guess guess = extrapolate(here, &before, 45);
  EXPECT_DOUBLE_EQ(guess.state.x[0], 4);
  EXPECT_DOUBLE_EQ(guess.state.p[0], 40);
  EXPECT_DOUBLE_EQ(guess.memory.bounds[0], 11);
  EXPECT_EQ(guess.memory.penalty, 7);
}

// The plates became stiffer at 50 mm, which moved the body by 0.5 mm; the plates alone, by 2 mm.
TEST(Extrapolate, LeavesOutWhatStifferPlatesMoved) {
  const Waypoint before = waypoint(60, 1, {0}, {5});
  Waypoint here = waypoint(50, 3.5, {0}, {9});
  here.moved.x.setConstant(3);
  here.moved.p.setConstant(30);
  here.state.p.setConstant(35);
  const Guess guess = extrapolate(here, &before, 45);
  EXPECT_DOUBLE_EQ(guess.state.x[0], 4.5);
  EXPECT_DOUBLE_EQ(guess.state.p[0], 45);
}

// Bounds stay at or above zero, and those of nodes that changed their plate are kept.
TEST(Extrapolate, BoundsOfNodesThatStayOnTheirPlateOnly) {
  const Waypoint before = waypoint(60, 1, {0, 0, -1, 1}, {5, 9, 0, 4});
  const Waypoint here = waypoint(50, 3, {0, 1, 0, 1}, {2, 3, 4, 4});
  const Guess guess = extrapolate(here, &before, 40);
  EXPECT_EQ(guess.memory.bounds, (std::vector<double>{0, 3, 4, 4}));
}

// Two states at 60 and 50 mm, of a method without friction.
TEST(Extrapolate, NeedsNoFriction) {
  const Waypoint before = waypoint(60, 1, {0}, {}), here = waypoint(50, 3, {0}, {});
  EXPECT_TRUE(extrapolate(here, &before, 40).memory.bounds.empty());
}

Waypoint at(double thickness) {
  return waypoint(thickness, thickness, {}, {});
}

TEST(Trail, GoesBackToItsStart) {
  Trail trail;
  trail.begin(at(60));
  EXPECT_EQ(trail.before(), nullptr);
  for (const double thickness : {55, 50}) trail.advance(at(thickness));
  EXPECT_EQ(trail.before()->thickness, 55);
  EXPECT_TRUE(trail.step_back());
  EXPECT_EQ(trail.here().thickness, 55);
  EXPECT_EQ(trail.before()->thickness, 60);
  EXPECT_TRUE(trail.step_back());
  EXPECT_EQ(trail.here().thickness, 60);
  EXPECT_EQ(trail.before(), nullptr);
  EXPECT_FALSE(trail.step_back());
}

// Only the last states are kept; from the oldest of them the way back leads to the start.
TEST(Trail, SkipsWhatLiesTooFarBack) {
  Trail trail;
  trail.begin(at(60));
  for (int thickness = 59; thickness >= 50; --thickness) trail.advance(at(thickness));
  std::vector<double> back;
  while (trail.step_back()) back.push_back(trail.here().thickness);
  EXPECT_EQ(back, (std::vector<double>{51, 52, 53, 54, 60}));
}

// What was behind an abandoned branch is not returned to.
TEST(Trail, ForgetsWhatFollowedTheStateFromWhichItRestarts) {
  Trail trail;
  trail.begin(at(60));
  for (const double thickness : {55, 50, 45}) trail.advance(at(thickness));
  trail.restart_at(at(55));
  EXPECT_EQ(trail.before(), nullptr);
  trail.advance(at(48));
  trail.advance(at(47));
  EXPECT_TRUE(trail.step_back());
  EXPECT_TRUE(trail.step_back());
  EXPECT_EQ(trail.here().thickness, 55);
  EXPECT_TRUE(trail.step_back());
  EXPECT_EQ(trail.here().thickness, 60);
}

}  // namespace
}  // namespace breast
