// SPDX-License-Identifier: GPL-3.0-or-later
// The material sets among which the calibration of a cohort searches.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "identification/calibration/softness.hpp"

using namespace breast;

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
