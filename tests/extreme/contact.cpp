// SPDX-License-Identifier: GPL-3.0-or-later
// Compression far from the ordinary: every case ends as it states success to be. The
// cases are those of the table that are quick; bench/stability_contact runs them all.
#include <gtest/gtest.h>

#include "fixtures/contact_cases.hpp"

using namespace breast;

namespace {

std::vector<fixtures::ContactCase> quick_cases() {
  std::vector<fixtures::ContactCase> quick;
  for (fixtures::ContactCase& which : fixtures::contact_cases()) {
    if (!which.quick) continue;
    quick.push_back(std::move(which));
  }
  return quick;
}

}  // namespace

class ContactExtreme : public testing::TestWithParam<fixtures::ContactCase> {};

TEST_P(ContactExtreme, Succeeds) {
  using fixtures::Outcome;
  const fixtures::ContactOutcome end = run_contact_case(GetParam());
  EXPECT_TRUE(succeeded(GetParam(), end))
      << outcome_name(end.outcome) << " at "
      << (end.summary.contact ? end.summary.contact->reduction_percent : 0) << " %: " << end.reason;
  EXPECT_EQ(end.outcome == Outcome::converged, end.reason.empty()) << end.reason;
  EXPECT_EQ(end.outcome == Outcome::converged, end.reason_id.empty()) << end.reason_id;
  if (end.outcome != Outcome::converged && end.outcome != Outcome::stopped_early) return;
  // Whatever was reached is an equilibrium: no folded element, nothing penetrated, forces balanced.
  EXPECT_GT(end.summary.min_det_F, 0);
  // Nodes are kept out exactly, points of faces to what the plates give.
  const bool faces = !end.summary.path.final_step.pressed.empty();
  EXPECT_LT(end.summary.path.final_step.worst_penetration, faces ? 0.0351 : 1e-6);
  EXPECT_LT(end.summary.force_balance, 1e-7);
  EXPECT_LT(end.summary.residual, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Cases, ContactExtreme, testing::ValuesIn(quick_cases()),
                         [](const auto& which) {
                           std::string name = which.param.name;
                           std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
                           return name;
                         });
