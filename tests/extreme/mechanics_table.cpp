// SPDX-License-Identifier: GPL-3.0-or-later
// The part of the table of extreme cases that every change must pass.
#include <gtest/gtest.h>

#include "extreme/table/cases.hpp"

namespace breast::extreme {
namespace {

std::vector<Case> tested_cases() {
  std::vector<Case> tested;
  for (Case& each : cases()) {
    if (each.tested) tested.push_back(std::move(each));
  }
  return tested;
}

std::string identifier(const testing::TestParamInfo<Case>& info) {
  std::string name;
  for (const char c : info.param.name) name += std::isalnum(c) ? c : '_';
  return name;
}

class Extreme : public testing::TestWithParam<Case> {};

// A converged solve closes to a stated bound; another stops with a reason by name.
TEST_P(Extreme, ConvergesOrSaysWhyNot) {
  for (const Row& row : solve(GetParam().make())) {
    const SolveSummary& s = row.summary;
    if (GetParam().expected != "typed") {
      EXPECT_EQ(row.outcome(), GetParam().expected) << row.direction << ": " << s.record.reason;
    }
    if (s.converged()) {
      EXPECT_LT(s.residual, 1e-8) << row.direction;
      EXPECT_LT(s.max_volume_error, 1e-8) << row.direction;
      EXPECT_LT(row.closure_mm, 1e-8) << row.direction;
      EXPECT_EQ(s.steps, 1) << row.direction;
      EXPECT_LE(s.newton_iterations, 9) << row.direction;
      EXPECT_TRUE(s.reason_id.empty());
    } else {
      EXPECT_FALSE(s.reason_id.empty()) << row.direction;
      EXPECT_FALSE(s.record.reason.empty()) << row.direction;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cases, Extreme, testing::ValuesIn(tested_cases()), identifier);

}  // namespace
}  // namespace breast::extreme
