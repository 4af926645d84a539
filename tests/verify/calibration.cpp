// SPDX-License-Identifier: GPL-3.0-or-later
// The calibration finds a phantom again from the way its landmarks move.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "identification/calibration/calibrate.hpp"
#include "identification/calibration/softness.hpp"

using namespace breast;

TEST(Calibration, FindsTheSizeAndTumourThatMadeTheMotions) {
  const MaterialSet materials = load_materials("seed2008");
  const MeshParameters coarse{2, 1, 1, 1, 2, 2};
  BreastParameters hidden = resized(kind_breast("small"), 0.94);
  hidden.tumour_aside = 0.30;
  PhantomParameters parameters = phantom_preset("small", 1, hidden);
  parameters.mesh = coarse;
  const LandmarkMotion wanted = landmark_motion(parameters, Side::left, materials);
  EXPECT_GT(wanted.nipple_supine, wanted.nipple_free);

  const Calibration found =
      calibrate("small", 1, Side::left, wanted, materials, coarse, 10, no_progress());
  EXPECT_LE(found.evaluations, 10);
  EXPECT_NEAR(found.size, 0.94, 0.015);
  EXPECT_LT(found.misfit_mm, 0.1);
}

// The preset `paper` ended with its tumour_level on the lower bound, and nobody was told.
TEST(Calibration, AParameterOnItsBoundIsNamed) {
  Calibration found;
  found.size = 0.8938, found.tumour_aside = 0.6679, found.tumour_level = 0.6;
  EXPECT_TRUE(found.on_bounds().empty());
  found.tumour_level = 0.5;
  ASSERT_EQ(found.on_bounds().size(), 1u);
  EXPECT_NE(found.on_bounds()[0].find("tumour_level 0.5 lies on its bound (0.5 to 0.7)"),
            std::string::npos)
      << found.on_bounds()[0];
  found.size = 1.2999;  // within what the search resolves
  EXPECT_EQ(found.on_bounds().size(), 2u);
}

TEST(Softness, ScalesLinearAndQuadraticTermsApart) {
  const MaterialSet base = load_materials("seed2008");
  Softness s;
  s.low_order = 0.5, s.quadratic = 0.1, s.skin = 2;
  s.wall = "slide:0.03", s.cut = "spring:0.04,0.05";
  const MaterialSet set = softened(base, s).materials;
  const std::vector<double>&was = base.law(Tissue::fat).constants,
        &is = set.law(Tissue::fat).constants;
  EXPECT_NEAR(is[0], 0.5 * was[0], 1e-12);
  EXPECT_NEAR(is[1], 0.5 * was[1], 1e-12);
  for (int k = 2; k < 5; ++k) EXPECT_NEAR(is[k], 0.1 * was[k], 1e-12);
  const MaterialSet stiff = softened(base, s, 5).materials;
  const std::vector<double>&gland = stiff.law(Tissue::fibroglandular).constants,
        &muscle = stiff.law(Tissue::muscle).constants;
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(muscle[k], 5 * gland[k], 1e-9);
  EXPECT_EQ(set.wall, s.wall);
  EXPECT_EQ(set.cut, s.cut);
  EXPECT_THROW(softened(load_materials("victre"), s), Error);
}
