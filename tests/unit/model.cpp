// SPDX-License-Identifier: GPL-3.0-or-later
// The model of a shape: stated as texts, read back to the last digit, compared, overridden; and the
// closure of the stress-free shape found with it.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mechanics/closure.hpp"
#include "mechanics/model.hpp"

namespace breast {
namespace {

MechanicsOptions of(const MechanicsTexts& texts) {
  return mechanics_options(texts);
}

MechanicsTexts set(const std::string& name) {
  MechanicsTexts texts;
  texts.materials = name;
  return texts;
}

TEST(Model, ReadsBackToTheLastDigit) {
  for (const std::string& name : material_set_names()) {
    MechanicsTexts texts = set(name);
    texts.scale = {"fat=70", "skin=133.3", "muscle=17"};
    texts.element = "q2p1", texts.invariants = "plain", texts.bulk_ratio = "333.3333333333333";
    texts.wall = "spring:0.12345678901234567,0.033333333333333333";
    texts.cut = "spring:0.0012345678901234,0.1";
    texts.skin_compression = 7, texts.skin_prestretch = 2.9, texts.skin_smoothing = 0.013;
    for (const MechanicsOptions& used : {of(set(name)), of(texts)}) {
      const ModelText text = model_text(used);
      const MechanicsOptions back = stated_model(text, "x.vtkhdf");
      EXPECT_EQ(model_text(back), text) << name;
      EXPECT_EQ(model_differences(back, used), "") << name;
      EXPECT_EQ(back.materials.laws, used.materials.laws) << name;
      EXPECT_EQ(back.materials.density, used.materials.density) << name;
      EXPECT_EQ(back.materials.skin.kept, used.materials.skin.kept) << name;
      EXPECT_EQ(back.materials.skin.prestretch, used.materials.skin.prestretch) << name;
      EXPECT_EQ(back.materials.skin.smoothing, used.materials.skin.smoothing) << name;
      EXPECT_EQ(back.materials.uncertainty.covariance, used.materials.uncertainty.covariance);
      EXPECT_EQ(back.bulk_ratio, used.bulk_ratio) << name;
      EXPECT_EQ(back.wall->stiffness(), used.wall->stiffness()) << name;
      EXPECT_EQ(back.cut->stiffness(), used.cut->stiffness()) << name;
    }
  }
}

// Seven per cent is 0.07, but 100 times 0.07 is not 7.
TEST(Model, PerCentsOfSkinReadBackExactly) {
  for (double percent = 0.1; percent <= 100; percent += 0.1) {
    MechanicsTexts texts = set("invivo");
    texts.skin_compression = percent;
    const MechanicsOptions used = of(texts), back = stated_model(model_text(used), "x.vtkhdf");
    ASSERT_EQ(back.materials.skin.kept, used.materials.skin.kept) << percent;
  }
}

TEST(Model, EveryDifferenceIsNamed) {
  const MechanicsOptions stated = of(set("invivo"));
  const auto differences = [&](const MechanicsTexts& texts) {
    return model_differences(mechanics_options(texts, stated), stated);
  };
  EXPECT_EQ(differences({}), "");
  EXPECT_EQ(differences(set("invivo")), "");
  EXPECT_EQ(differences({.scale = {"fat=50"}}), "stiffness of fat 50 instead of 100 %");
  EXPECT_EQ(differences({.scale = {"other=50"}}), "stiffness of other 50 instead of 100 %");
  EXPECT_EQ(
      differences({.invariants = "plain", .bulk_ratio = "1000", .wall = "held", .cut = "free"}),
      "--invariants plain instead of isochoric, --bulk-ratio 1000 instead of incompressible, "
      "--wall held instead of slide:0.0122, --cut free instead of spring:0.019");
  EXPECT_EQ(differences({.skin_prestretch = 4}), "--skin-prestretch 4 instead of 3 %");
  const std::string other = differences(set("seed2008"));
  for (const char* part :
       {"fat.a10 310 instead of 8.153 Pa", "skin.c ", "--skin-compression 100 instead of 5 %"})
    EXPECT_NE(other.find(part), std::string::npos) << other;
  EXPECT_NE(differences(set("wellman")).find("fat "), std::string::npos);
}

TEST(Model, WhatIsGivenReplacesOnlyWhatItNames) {
  MechanicsTexts first = set("invivo");
  first.scale = {"fat=50"};
  first.element = "q2p1", first.cut = "roller";
  const MechanicsOptions stated = of(first);
  const auto used = [&](const MechanicsTexts& texts) { return mechanics_options(texts, stated); };
  const double fat = stated.materials.law(Tissue::fat).constants[0];
  EXPECT_EQ(used({.scale = {"fat=200"}}).materials.law(Tissue::fat).constants[0], 2 * fat);
  EXPECT_EQ(used({.wall = "held"}).element, Element::q2p1);
  EXPECT_EQ(used({.wall = "held"}).cut->text(), "roller");
  EXPECT_EQ(used({.element = "q1p0"}).materials.law(Tissue::fat).constants[0], fat);
  EXPECT_EQ(used({.skin_smoothing = 0.01}).materials.skin.prestretch, 0.03);
  // A set without supports leaves those of the file; one with supports brings its own.
  EXPECT_EQ(used(set("seed2008")).wall->kind(), "slide");
  EXPECT_EQ(used(set("seed2008")).cut->kind(), "roller");
  EXPECT_EQ(used(set("invivo")).cut->kind(), "spring");
  // The options of the first solve, given again, are the same model.
  EXPECT_EQ(model_differences(used(first), stated), "");
  EXPECT_EQ(used({.bulk_ratio = "50"}).bulk_ratio, 50);
  MechanicsOptions compressible = stated;
  compressible.bulk_ratio = 50;
  EXPECT_EQ(mechanics_options({.bulk_ratio = "incompressible"}, compressible).bulk_ratio, 0);
  for (const char* bad : {"0", "0.5", "inf", "nan", "2e9", "soft"})
    EXPECT_THROW(parse_bulk_ratio(bad), Error) << bad;
}

// The weight of the tissue beyond needs a wall with springs, in the file's model as in a set's.
TEST(Model, ACutKeepsItsSpringsWhereTheWallIsHeld) {
  const MechanicsOptions stated = of(set("invivo-sternum"));
  ASSERT_EQ(stated.cut->kind(), "tissue");
  EXPECT_EQ(mechanics_options({.wall = "held"}, stated).cut->kind(), "spring");
}

TEST(Model, WithoutAnySetIsRefused) {
  EXPECT_THROW(mechanics_options(MechanicsTexts{}), Error);
}

TEST(Model, AMalformedOneIsRefusedWithItsFile) {
  const ModelText good = model_text(of(set("seed2008")));
  for (const auto& [name, text] : model_parts) {
    if (std::string(name) == "name") continue;
    ModelText bad = good;
    bad.*text = "no such thing";
    try {
      stated_model(bad, "x.vtkhdf");
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input) << name;
      EXPECT_EQ(std::string(error.what()).find("x.vtkhdf: group /breast/model cannot be read"), 0u)
          << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

class Closure : public testing::Test {
 protected:
  Closure() {
    mesh_.points = mesh_.imaged = {Vec3(0, 0, 0), Vec3(10, 0, 0)};
    again_.points = mesh_.imaged;
    again_.record.status = backward_.record.status = SolveStatus::converged;
  }
  HexMesh mesh_;
  Equilibrium again_, backward_;
};

TEST_F(Closure, OfRoundingIsConverged) {
  again_.points[1].x() += 1e-9;
  EXPECT_NEAR(*judge_closure(again_, mesh_, backward_), 1e-9, 1e-12);
  EXPECT_TRUE(backward_.converged());
  EXPECT_EQ(backward_.reason_id, "");
}

TEST_F(Closure, OfAnotherEquilibriumIsNotConverged) {
  again_.points[1].x() += 7.3;
  EXPECT_NEAR(*judge_closure(again_, mesh_, backward_), 7.3, 1e-12);
  EXPECT_EQ(backward_.record.status, SolveStatus::not_converged);
  EXPECT_EQ(backward_.reason_id, "not_closed");
  for (const char* part : {"7.3 mm", "1e-06 mm", "--scale", "--wall"})
    EXPECT_NE(backward_.record.reason.find(part), std::string::npos) << backward_.record.reason;
}

TEST_F(Closure, WithoutASolutionIsNotConverged) {
  again_.record.status = SolveStatus::not_converged;
  again_.record.reason = "iteration limit";
  EXPECT_FALSE(judge_closure(again_, mesh_, backward_));
  EXPECT_EQ(backward_.record.status, SolveStatus::not_converged);
  EXPECT_NE(backward_.record.reason.find("iteration limit"), std::string::npos);
}

}  // namespace
}  // namespace breast
