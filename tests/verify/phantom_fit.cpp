// SPDX-License-Identifier: GPL-3.0-or-later
// The fit finds a phantom again from the way its landmarks move.
#include "bench/phantom_fit.hpp"

#include <gtest/gtest.h>

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
