// The calibration finds a phantom again from the way its landmarks move.
#include <gtest/gtest.h>

#include "calibration/calibrate.hpp"

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
  EXPECT_TRUE(found.on_bounds().empty());
}

// Motions of a breast far larger than may be sought: the fit ends on a bound, and says so.
TEST(Calibration, AParameterOnItsBoundIsNamed) {
  const MeshParameters coarse{2, 1, 1, 1, 2, 2};
  const Calibration found = calibrate("small", 1, Side::left, {60, 20, 30, 10},
                                      load_materials("seed2008"), coarse, 8, no_progress());
  ASSERT_FALSE(found.on_bounds().empty());
  EXPECT_NE(found.on_bounds()[0].find("size 1.3"), std::string::npos) << found.on_bounds()[0];
  Calibration inside = found;
  inside.size = 1, inside.tumour_aside = 0.3, inside.tumour_level = 0.6;
  EXPECT_TRUE(inside.on_bounds().empty());
  inside.tumour_level = 0.5;  // where the preset `paper` ended
  EXPECT_EQ(inside.on_bounds().size(), 1u);
}
