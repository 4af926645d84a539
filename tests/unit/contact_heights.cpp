// SPDX-License-Identifier: GPL-3.0-or-later
// A view is positioned again where a rounded edge carries the breast, and only there.
#include "contact/heights.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace breast;

namespace {

CompressionResult result_with(SolveStatus status, double paddle_edge, double detector_edge) {
  CompressionResult result;
  result.record.status = status;
  result.contact.emplace();
  result.contact->plates.resize(2);
  result.contact->plates[0].force_N = 50;
  result.places.resize(2);
  result.places[0].edge_part = paddle_edge;
  result.places[1].edge_part = detector_edge;
  result.plates.initial_thickness = 160;
  result.plates.paddle_start = -70;
  result.plates.detector_start = 90;
  result.newton_iterations = 200;
  return result;
}

/// Results in turn, and the heights for which they were asked.
struct Script {
  std::vector<CompressionResult> results;
  std::vector<std::optional<double>> asked;

  CompressionResult run() {
    return at_best_height(
        [&](std::optional<double> middle) {
          asked.push_back(middle);
          return results.at(asked.size() - 1);
        },
        no_progress());
  }
};

HeightTried tried(double moved, double paddle, double detector) {
  HeightTried at;
  at.moved_mm = moved;
  at.force_N = 50;
  at.edge_percent[0] = paddle;
  at.edge_percent[1] = detector;
  return at;
}

TEST(ContactHeights, FirstMoveIsASixteenthOfTheThicknessAwayFromTheLoadedEdge) {
  EXPECT_DOUBLE_EQ(next_height({tried(0, 10, 60)}, 160).value(), 10);
  EXPECT_DOUBLE_EQ(next_height({tried(0, 60, 10)}, 160).value(), -10);
}

TEST(ContactHeights, SecondMoveBalancesTheEdges) {
  // 50 points become 25, or -50, or do not change.
  EXPECT_DOUBLE_EQ(next_height({tried(0, 10, 60), tried(10, 25, 50)}, 160).value(), 20);
  EXPECT_DOUBLE_EQ(next_height({tried(0, 10, 60), tried(10, 60, 10)}, 160).value(), 5);
  EXPECT_DOUBLE_EQ(next_height({tried(0, 60, 10), tried(-10, 10, 60)}, 160).value(), -5);
  EXPECT_DOUBLE_EQ(next_height({tried(0, 10, 60), tried(10, 10, 60)}, 160).value(), 20);
}

TEST(ContactHeights, SecondMoveIsHalfOfOneThatFoundNoForces) {
  EXPECT_DOUBLE_EQ(next_height({tried(0, 10, 60), HeightTried{}}, 160).value(), 5);
}

TEST(ContactHeights, AnAcceptedViewIsNotPositionedAgain) {
  Script script{{result_with(SolveStatus::converged, 0.1, 0.2)}, {}};
  EXPECT_EQ(script.run().heights.size(), 1U);
  EXPECT_EQ(script.asked, std::vector<std::optional<double>>{std::nullopt});
}

TEST(ContactHeights, AViewThatFailsForAnotherReasonIsNotPositionedAgain) {
  Script script{{result_with(SolveStatus::stopped_early, 0.1, 0.3)}, {}};
  EXPECT_EQ(script.run().heights.size(), 1U);
  EXPECT_FALSE(next_height({HeightTried{}}, 160));
}

TEST(ContactHeights, TheFirstAcceptedHeightIsTaken) {
  Script script{{result_with(SolveStatus::not_gripped, 0.1, 0.6),
                 result_with(SolveStatus::not_gripped, 0.2, 0.45),
                 result_with(SolveStatus::converged, 0.2, 0.3)},
                {}};
  const CompressionResult found = script.run();
  EXPECT_TRUE(found.converged());
  EXPECT_EQ(script.asked, (std::vector<std::optional<double>>{std::nullopt, 20, 30}));
  ASSERT_EQ(found.heights.size(), 3U);
  EXPECT_DOUBLE_EQ(found.heights[1].moved_mm, 10);
  EXPECT_DOUBLE_EQ(found.heights[0].edge_percent[1], 60);
  EXPECT_TRUE(found.heights[2].accepted);
}

TEST(ContactHeights, WithoutAnAcceptedHeightTheFirstResultStays) {
  Script script{{result_with(SolveStatus::not_gripped, 0.1, 0.6),
                 result_with(SolveStatus::not_gripped, 0.5, 0.5),
                 result_with(SolveStatus::stopped_early, 0.9, 0.1)},
                {}};
  const CompressionResult found = script.run();
  EXPECT_DOUBLE_EQ(found.places[1].edge_part, 0.6);
  EXPECT_EQ(found.heights.size(), 3U);
}

}  // namespace
