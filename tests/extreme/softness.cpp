// SPDX-License-Identifier: GPL-3.0-or-later
// A breast of every softness on every wall in every skin: a stable answer that closes, or a true
// reason with the change that would mend it.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/units.hpp"
#include "extreme/table/softness.hpp"
#include "fixtures/sliding_cap.hpp"

namespace breast::extreme {
namespace {

const Vec3 prone(0, -gravity_mm_s2, 0);

bool stands(const HexMesh& mesh, const MechanicsOptions& options) {
  const Equilibrium found = solve_backward(mesh, prone, options);
  return found.converged() && found.stable;
}

// The change it names as with_change takes it.
double size_of(const Remedy& remedy) {
  return remedy.factor > 0 ? std::log(remedy.factor)
                           : std::log(1 + remedy.support / usual_sliding_stiffness);
}

void check_reason(const Equilibrium& found) {
  static const std::set<std::string> known{
      "no_stress_free_body", "unstable_equilibrium", "left_wall_surface", "folded_element",
      "iteration_limit",     "no_admissible_step",   "indefinite_tangent"};
  EXPECT_TRUE(known.count(found.reason_id)) << found.reason_id;
  EXPECT_FALSE(found.record.reason.empty());
  EXPECT_TRUE(found.remedy) << found.record.reason;
}

class SoftnessTable : public testing::TestWithParam<Softness> {};

TEST_P(SoftnessTable, IsStableOrSaysWhyNot) {
  const SoftnessRow row = solve(fixtures::cap_on_sphere(), GetParam().options(fixtures::sphere()));
  // Of Table II the paper's skin stands down to 2 %, wrinkling skin everywhere, stiff skin to 10 %.
  const double least = GetParam().skin == SkinCase::stiff   ? 10
                       : GetParam().skin == SkinCase::paper ? 2
                                                            : 0;
  EXPECT_EQ(row.has_body, GetParam().percent >= least) << row.backward.record.reason;
  if (!row.has_body) {
    check_reason(row.backward);
    return;
  }
  for (const Equilibrium* found : {&row.backward, &row.supine, &row.prone}) {
    EXPECT_TRUE(found->converged()) << found->record.reason;
    EXPECT_TRUE(found->stable);
    EXPECT_EQ(found->steps, 1);
    EXPECT_LE(found->newton_iterations, 12);
    EXPECT_LT(found->residual, 1e-8);
    EXPECT_LT(found->max_volume_error, 1e-8);
  }
  EXPECT_LT(row.closure_mm, 1e-8);
}

std::string identifier(const testing::TestParamInfo<Softness>& info) {
  std::string name;
  for (const char c : info.param.name()) name += std::isalnum(c) ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Cells, SoftnessTable, testing::ValuesIn(softness_cells()), identifier);

// The change that a reason names is enough, and a sixth less of it is not. Stiff skin on soft tissue
// is named as what buckles, and skin that wrinkles stands.
TEST(Remedy, IsEnoughAndHardlyMoreThanThat) {
  const HexMesh mesh = fixtures::cap_on_sphere();
  for (const Softness& cell :
       {Softness{5, true, SkinCase::stiff}, Softness{2, false, SkinCase::stiff},
        Softness{0.5, true, SkinCase::paper}}) {
    const MechanicsOptions options = cell.options(fixtures::sphere());
    const Equilibrium found = solve_backward(mesh, prone, options);
    EXPECT_EQ(found.reason_id, "unstable_equilibrium") << cell.name();
    ASSERT_TRUE(found.remedy) << cell.name();
    const Remedy& remedy = *found.remedy;
    EXPECT_NE(found.record.reason.find(remedy.words()), std::string::npos);
    const double size = std::abs(size_of(remedy)), sign = size_of(remedy) < 0 ? -1 : 1;
    EXPECT_TRUE(stands(mesh, *with_change(options, remedy.what, sign * size))) << cell.name();
    EXPECT_FALSE(stands(mesh, *with_change(options, remedy.what, sign * size * 5 / 6)))
        << cell.name();
    ASSERT_TRUE(found.skin_share);
    EXPECT_GT(*found.skin_share, 0.9);
    EXPECT_NE(found.record.reason.find("compressed skin buckles"), std::string::npos);
    EXPECT_NE(found.record.reason.find("--skin-compression 5"), std::string::npos);
    MechanicsOptions wrinkling = options;
    wrinkling.materials.skin.kept = 0.05;
    wrinkling.materials.skin.prestretch = 0.03;
    EXPECT_TRUE(stands(mesh, wrinkling)) << cell.name();
  }
}

// On its back a breast that slides without resistance is a pendulum on its head: no stiffness of the
// tissue helps, springs do.
TEST(Remedy, OfABreastThatSlidesOffIsASupport) {
  HexMesh mesh = fixtures::cap_on_sphere();
  Softness cell{20, true, SkinCase::paper};
  MechanicsOptions options = cell.options(fixtures::sphere());
  options.wall = wall_support("slide:0");
  options.cut = cut_support("free");
  const Equilibrium found = solve_forward(mesh, -prone, options);
  ASSERT_FALSE(found.converged());
  ASSERT_TRUE(found.remedy) << found.record.reason;
  const Remedy& remedy = *found.remedy;
  EXPECT_TRUE(remedy.what == "wall" || remedy.what == "cut") << remedy.words();
  EXPECT_EQ(remedy.factor, 0);
  EXPECT_GT(remedy.support, 0);
  const double size = size_of(remedy);
  EXPECT_TRUE(solve_forward(mesh, -prone, *with_change(options, remedy.what, size)).converged());
  EXPECT_FALSE(
      solve_forward(mesh, -prone, *with_change(options, remedy.what, size * 5 / 6)).converged());
}

}  // namespace
}  // namespace breast::extreme
