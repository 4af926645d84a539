// Compression far from the ordinary: every run ends converged or with a true, typed reason. The
// cases are those of the table that are quick; bench/stability_contact runs them all.
#include <gtest/gtest.h>

#include "fixtures/contact_cases.hpp"

using namespace breast;

namespace {

std::vector<fixtures::ContactCase> quick_cases() {
  std::vector<fixtures::ContactCase> quick;
  for (fixtures::ContactCase& which : fixtures::contact_cases()) {
    if (!which.quick) continue;
    which.mesh_size = 5;
    quick.push_back(std::move(which));
  }
  return quick;
}

}  // namespace

class ContactExtreme : public testing::TestWithParam<fixtures::ContactCase> {};

TEST_P(ContactExtreme, EndsConvergedOrWithATrueReason) {
  const fixtures::ContactOutcome end = run_contact_case(GetParam());
  if (GetParam().at_least < 0) {
    EXPECT_EQ(end.outcome, "refused") << end.reason;
    EXPECT_FALSE(end.reason.empty());
    return;
  }
  ASSERT_TRUE(end.outcome == "converged" || end.outcome == "stopped_early") << end.reason;
  EXPECT_EQ(end.outcome == "converged", end.reason.empty()) << end.reason;
  EXPECT_GE(end.summary.reduction_percent, GetParam().at_least - 1e-6) << end.reason;
  // Whatever was reached is an equilibrium: no folded element, nothing penetrated, forces balanced.
  EXPECT_GT(end.summary.min_det_F, 0);
  EXPECT_LT(end.paddle.worst_gap_mm, 1e-6);
  EXPECT_LT(end.summary.force_balance, 1e-7);
  EXPECT_LT(end.summary.residual, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Cases, ContactExtreme, testing::ValuesIn(quick_cases()),
                         [](const auto& which) {
                           std::string name = which.param.name;
                           std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
                           return name;
                         });
