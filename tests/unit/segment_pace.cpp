// SPDX-License-Identifier: GPL-3.0-or-later
// The share of the time that has passed when a stage of segment begins.
#include "segment/pace.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace breast {
namespace {

struct Heard final : Progress {
  std::vector<double> fractions;
  std::vector<std::string> notes;
  void update(std::string_view, double fraction, std::string_view) override {
    fractions.push_back(fraction);
  }
  void note(std::string_view text) override { notes.emplace_back(text); }
};

TEST(Pace, GoesOnFromNothingToTheEnd) {
  const Pace pace(no_progress(), 35'000'000, 2'000'000, 18'000'000);
  EXPECT_EQ(pace.passed(0), 0);
  EXPECT_NEAR(pace.passed(1), 0.95, 0.02) << "then the result is written";
  for (double share = 0.01; share <= 1; share += 0.01)
    EXPECT_GT(pace.passed(share), pace.passed(share - 0.01)) << share;
  EXPECT_EQ(pace.passed(1.5), pace.passed(1));
}

// Seconds that the stages took with one thread.
TEST(Pace, TellsTheTimeLeftWithinAFactorOfTwoFromTheFirstStageOn) {
  struct Measured {
    const char* scan;
    std::size_t scanned, working, of_side;
    double body, wall, tissue;
  };
  for (const Measured& m : {Measured{"668 x 287 x 183, 0.5 x 0.5 x 1.6 mm", 35'100'000, 1'950'000,
                                     17'800'000, 0.77, 2.02, 11.98},
                            Measured{"256 x 256 x 40, 1.3 x 1.3 x 4 mm", 2'600'000, 2'600'000,
                                     1'200'000, 0.68, 2.95, 1.15}}) {
    const Pace pace(no_progress(), m.scanned, m.working, m.of_side);
    const auto left_at = [&](double stage, double seconds) {
      return seconds * (1 - pace.passed(stage)) / pace.passed(stage);
    };
    const auto expect_near = [&](double estimate, double left) {
      EXPECT_GT(estimate, left / 2) << m.scan;
      EXPECT_LT(estimate, 2 * left) << m.scan;
    };
    expect_near(left_at(stage_begin::first_wall, m.body), m.wall + m.tissue);
    expect_near(left_at(stage_begin::tissue, m.body + m.wall), m.tissue);
  }
}

TEST(Pace, PassesOnWhatIsUnknownAndNotes) {
  Heard heard;
  Pace pace(heard, 1000, 1000, 500);
  pace.update("body", -1, "");
  pace.update("body", 0, "");
  pace.note("said");
  EXPECT_EQ(heard.fractions, (std::vector<double>{-1, 0}));
  EXPECT_EQ(heard.notes, std::vector<std::string>{"said"});
}

}  // namespace
}  // namespace breast
