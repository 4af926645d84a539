// SPDX-License-Identifier: GPL-3.0-or-later
// One synthetic patient scanned badly in many ways: the same breast, or a refusal in one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "evaluation/overlap.hpp"
#include "evaluation/wall_distance.hpp"
#include "fixtures/perturbed_scan.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "segment/body/body.hpp"
#include "segment/body/field_of_view.hpp"
#include "segment/contrast/evidence.hpp"
#include "segment/grid/itk_filters.hpp"
#include "segment/grid/noise.hpp"
#include "segment/plausibility.hpp"
#include "segment/quality.hpp"
#include "segment/segment.hpp"
#include "segment/work.hpp"

namespace breast {
namespace {

using testing::SyntheticScan;

Segmentation run(const Volume<float>& scan, const SegmentOptions& options = {}) {
  Timer timer;
  return segment_breast(scan, options, no_progress(), timer);
}

std::string refusal(const Volume<float>& scan) {
  try {
    run(scan);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    return error.what();
  }
  return "";
}

struct Patient {
  SyntheticScan truth;
  Volume<float> scan = truth.image();
  Segmentation base = run(scan);
};

const Patient& patient() {
  static const Patient one;
  return one;
}

void expect_same(const Segmentation& result, double dice, double wall_mm, double nipple_mm) {
  const LabelVolume &ours = result.labels, &base = patient().base.labels;
  EXPECT_GT(compare_labels(ours, base).breast.dice, dice);
  EXPECT_LT(compare_walls(ours, base).distance.mean_mm, wall_mm);
  EXPECT_LT((ours.landmarks.at("nipple") - base.landmarks.at("nipple")).norm(), nipple_mm);
}

void expect_same(const Volume<float>& scan, double dice, double wall_mm, double nipple_mm) {
  expect_same(run(scan), dice, wall_mm, nipple_mm);
}

TEST(SegmentRobustness, FourfoldNoise) {
  expect_same(testing::noisier(patient().scan, 4), 0.96, 1, 4);
}
TEST(SegmentRobustness, TwiceTheBias) {
  expect_same(testing::more_biased(patient().scan, 2), 0.97, 0.7, 4);
}
TEST(SegmentRobustness, NoiseOf15PercentOfTheBrightest) {
  expect_same(testing::noisy(patient().scan, 0.15), 0.94, 1.5, 6);
}
// In single voxels of gland and muscle there is then no more signal than in air.
TEST(Noise, SpeckleGoesAndEdgesStay) {
  Grid grid;
  grid.size = {40, 40, 10};
  grid.spacing = Vec3(1, 1, 2);
  Volume<float> scan(grid);
  for (int k = 0; k < 10; ++k)
    for (int j = 10; j < 40; ++j)
      for (int i = 0; i < 40; ++i) scan.at(i, j, k) = i < 20 ? 100 : 40;
  EXPECT_FALSE(is_speckle(noise_of(scan)));
  Volume<float> noisy = testing::noisy(scan, 0.1);
  EXPECT_TRUE(is_speckle(noise_of(noisy)));
  const auto off = [&](const Volume<float>& one) {
    double sum = 0;
    for (std::size_t n = 0; n < one.voxels.size(); ++n)
      sum += std::abs(one.voxels[n] - scan.voxels[n]) / double(one.voxels.size());
    return sum;
  };
  const double before = off(noisy);
  remove_speckle(noisy);
  EXPECT_LT(off(noisy), 0.7 * before);
  remove_speckle(scan);
  EXPECT_EQ(scan.at(19, 30, 5), 100);
  EXPECT_EQ(scan.at(20, 30, 5), 40);
}
/// Magnitude images: where there is no signal, the noise has a mean of 1.25 of its deviation.
TEST(Noise, IsTakenFromSignalAndAirAlike) {
  Grid grid;
  grid.size = {60, 60, 20};
  grid.spacing = Vec3(1, 1, 2);
  constexpr double deviation = 10;
  Volume<float> scan(grid);
  for (int k = 0; k < 20; ++k)
    for (int j = 20; j < 60; ++j)
      for (int i = 0; i < 60; ++i) scan.at(i, j, k) = i < 30 ? 100 : 20;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0, deviation);
  for (float& v : scan.voxels) v = float(std::hypot(v + normal(random), normal(random)));
  const double found = disturbing_noise(scan, noise_of(scan));
  EXPECT_NEAR(found, deviation, 0.5);
  const Volume<float> signal = without_noise(scan, found);
  const auto mean = [&](int first, int last, int row) {
    double sum = 0;
    for (int k = 5; k < 15; ++k)
      for (int i = first; i < last; ++i) sum += signal.at(i, row, k) / (10.0 * (last - first));
    return sum;
  };
  EXPECT_NEAR(mean(8, 22, 40), 100, 3);
  EXPECT_NEAR(mean(38, 52, 40), 20, 2);
  EXPECT_LT(mean(8, 52, 5), deviation);
  for (float& v : scan.voxels) v += 400;
  scan.at(0, 0, 0) = 0;
  EXPECT_EQ(without_noise(scan, 0).voxels, scan.voxels);
}

/// Sampled along other axes, a scan has no data in its corners; where air has been set to zero it
/// has.
TEST(FieldOfView, PaddingIsNoAirAndNoEdgeOfTheBody) {
  EXPECT_TRUE(voxels_with_data(patient().scan).voxels.empty());
  Volume<float> dark_air = patient().scan;
  for (float& v : dark_air.voxels)
    if (v < 60) v = 0;
  EXPECT_TRUE(voxels_with_data(dark_air).voxels.empty());
  Volume<float> padded = testing::oblique(patient().scan, 12);
  const Mask seen = voxels_with_data(padded);
  ASSERT_EQ(seen.voxels.size(), padded.voxels.size());
  std::size_t wrong = 0, missing = 0;
  for (std::size_t n = 0; n < seen.voxels.size(); ++n) {
    wrong += (seen.voxels[n] != 0) != (padded.voxels[n] > 0);
    missing += seen.voxels[n] == 0;
  }
  EXPECT_GT(missing, seen.voxels.size() / 50);
  EXPECT_LT(wrong, missing / 20);
  continue_beyond_data(padded, seen);
  EXPECT_TRUE(
      std::none_of(padded.voxels.begin(), padded.voxels.end(), [](float v) { return v == 0; }));
}

/// Coils in front of the patient may leave the chest as dark as air, to the back and the sides:
/// where the chest wall is sought there must be body all the same.
TEST(Body, ChestAsDarkAsAirIsFilled) {
  const SyntheticScan& truth = patient().truth;
  Volume<float> scan = patient().scan;
  const Grid& grid = scan.grid;
  const auto everywhere = [&](const auto& act) {
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i)
          act(grid.to_patient(Vec3(i, j, k)), grid.offset(i, j, k));
      }
    }
  };
  everywhere([&](const Vec3& p, std::size_t n) {
    const double behind = p[1] - truth.wall(p[0], p[2]);
    scan.voxels[n] *= float(std::exp(-std::max(0.0, behind) / 12));
  });
  const Mask body = find_body(scan, Side::left).mask;
  double chest = 0, found = 0, air = 0, taken = 0;
  everywhere([&](const Vec3& p, std::size_t n) {
    if (truth.behind_wall(p) && std::abs(p[0]) < 125 && p[1] < 90) {
      chest += 1;
      found += body.voxels[n];
    } else if (p[1] < 40 && !truth.in_body(p)) {
      air += 1;
      taken += body.voxels[n];
    }
  });
  EXPECT_GT(found, 0.99 * chest);
  EXPECT_LT(taken, 0.01 * air);
}

/// A coil plate 12 mm behind the nipple: what would hang in front of it is flat.
TEST(SegmentRobustness, SkinFlattenedByTheCoilIsDoubted) {
  const auto flat_doubts = [](const Segmentation& result) {
    return std::count_if(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
      return doubt.find("are flat") != std::string::npos;
    });
  };
  EXPECT_EQ(flat_doubts(patient().base), 0);
  const Segmentation flattened =
      run(testing::pressed(patient().scan, patient().truth.nipple(1)[1] + 12));
  EXPECT_EQ(flat_doubts(flattened), 1);
  EXPECT_GT(flattened.flat_skin_cm2, 6);
}

TEST(SegmentRobustness, ImplausibleExtentIsDoubted) {
  const auto doubts_of = [](const Segmentation& result, double left_out) {
    const Extents found{.front_left_out_percent = left_out,
                        .lateral_border_mm = result.lateral_border_mm,
                        .nipple_depth_mm = result.nipple_depth_mm,
                        .view_behind_sternum_mm = result.view_behind_sternum_mm,
                        .volume_ml = 500};
    return extent_doubts(found, result.greatest_thickness).size();
  };
  const Segmentation& base = patient().base;
  EXPECT_EQ(doubts_of(base, base.front_left_out_percent), 0u);
  EXPECT_EQ(doubts_of(base, 40), 1u) << "tissue in front of the sternum left out";
  Segmentation wrong = base;
  wrong.lateral_border_mm = 40;
  wrong.nipple_depth_mm = 0.4 * base.greatest_thickness;
  EXPECT_EQ(doubts_of(wrong, base.front_left_out_percent), 2u);
}

TEST(SegmentRobustness, AViewThatEndsSoonBehindTheSternumIsDoubted) {
  const auto is_doubted = [](const Segmentation& result) {
    return std::any_of(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
      return doubt.find("extent doubtful: the field of view ends") == 0;
    });
  };
  EXPECT_FALSE(is_doubted(patient().base));
  const Volume<float>& scan = patient().scan;
  const Grid& grid = scan.grid;
  const double end =
      patient().truth.wall(0, 0) + 15;  // y; the skin lies 10 mm in front of the wall
  const Segmentation cut = run(testing::cropped(
      scan, {0, 0, 0},
      {grid.size[0] - 1, int((end - grid.origin[1]) / grid.spacing[1]), grid.size[2] - 1}));
  EXPECT_NEAR(cut.view_behind_sternum_mm, 25, 4);
  EXPECT_TRUE(is_doubted(cut));
}

TEST(SegmentRobustness, ThickSlices) {
  expect_same(testing::with_slices(patient().scan, 5), 0.95, 1, 4);
}
TEST(SegmentRobustness, ObliqueAxes) {
  const Segmentation result = run(testing::oblique(patient().scan, 15));
  EXPECT_NEAR(std::abs(result.roll_degrees), 15, 1);
  expect_same(result, 0.92, 1.5, 6);
}
TEST(SegmentRobustness, ObliqueAxesOfANarrowFieldOfView) {
  const Segmentation result = run(testing::oblique(testing::narrower(patient().scan, 0.08), 12));
  EXPECT_NEAR(std::abs(result.roll_degrees), 12, 1.5);
  EXPECT_NEAR(result.midline_mm, patient().base.midline_mm, 6);
}
TEST(SegmentRobustness, NarrowFieldOfView) {
  expect_same(testing::narrower(patient().scan, 0.04), 0.93, 1, 4);
}

TEST(SegmentRobustness, OneBreastAloneInTheFieldOfView) {
  const Volume<float> alone = testing::one_breast(patient().scan, true);
  const Segmentation result = run(alone);
  // Anywhere on the flat of the sternum that is in view; the breast does not hang on it.
  EXPECT_NEAR(result.midline_mm, patient().base.midline_mm, 25);
  expect_same(result, 0.95, 0.7, 4);
  ASSERT_FALSE(result.doubts.empty());
  EXPECT_TRUE(std::any_of(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
    return doubt.find("only one breast is in") != std::string::npos;
  }));
  for (const std::string& doubt : patient().base.doubts)
    EXPECT_EQ(doubt.find("only one breast is in"), std::string::npos);
}
TEST(SegmentRobustness, PermutedAxesGiveTheSameVoxels) {
  const Segmentation result = run(testing::sagittal(patient().scan));
  EXPECT_EQ(result.labels.tissue, patient().base.labels.tissue);
  EXPECT_LT(
      (result.labels.landmarks.at("nipple") - patient().base.labels.landmarks.at("nipple")).norm(),
      1e-6);
}

TEST(SegmentRobustness, SaturatedFatShowsTheWallBesideBrightMuscle) {
  const SyntheticScan& truth = patient().truth;
  const auto fat_of = [&](int, int j, int) {
    const double y = truth.grid.to_patient(Vec3(0, j, 0))[1];
    const double wall = truth.wall(truth.half_width, 0);
    return 200 * std::pow(truth.bias, std::clamp((wall - y) / 80, -0.5, 1.2));
  };
  const Segmentation result = run(testing::fat_saturated(patient().scan, fat_of));
  EXPECT_EQ(result.kind, Contrast::fat_suppressed);
  // This body has no skin, which is bright where fat is suppressed and shows where the breast ends.
  EXPECT_GT(compare_labels(result.labels, patient().base.labels).breast.dice, 0.88);
  EXPECT_LT(compare_walls(result.labels, patient().base.labels).distance.mean_mm, 1);
}

/// As in a scan seen: fat varies, saturated unevenly, and is darker than skin and gland; muscle has
/// 0.59 of it, and beneath the skin there is still half of the brightness around.
Volume<float> unevenly_saturated() {
  const SyntheticScan& truth = patient().truth;
  return truth.image_of([&](const Vec3& p) {
    const double signal = truth.signal(p);
    const double fat = 0.4 + 0.04 * (std::sin(p[0] / 3) + std::sin(p[1] / 4) + std::sin(p[2] / 5));
    if (signal == 0) return 0.0;
    if (truth.in_skin(p, 4)) return 1.8 * 0.4;
    return signal == 1 ? fat : signal == 0.6 ? 0.7 : signal == 0.35 ? 0.59 * 0.4 : 0.03;
  });
}

TEST(SegmentRobustness, UnevenlySaturatedFatIsRefusedUnlessToldOtherwise) {
  const Volume<float> scan = unevenly_saturated();
  const std::string reason = refusal(scan);
  EXPECT_NE(reason.find("fat is saturated"), std::string::npos) << reason;
  EXPECT_NE(reason.find("--contrast fat-bright"), std::string::npos) << reason;
  SegmentOptions told;
  told.contrast = Contrast::fat_bright;
  const Segmentation result = run(scan, told);
  EXPECT_GT(saturation_evidence(result.contrast), most_evidence);
  EXPECT_TRUE(std::any_of(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
    return doubt.find("accepted as requested: fat is saturated") == 0;
  }));
  EXPECT_EQ(run(patient().scan, told).labels.tissue, patient().base.labels.tissue);
}

TEST(Contrast, OneOddityIsNoSaturationTwoAre) {
  // In a real fat-saturated scan; the farthest of scans with bright fat, phantoms included.
  const FatContrast saturated{1.7, 0.55, 0.10, 0.59}, bright{1.14, 0.54, 0.086, 0.45};
  EXPECT_NE(refusal_of(saturated), "");
  EXPECT_EQ(refusal_of(bright), "");
  for (int odd = 0; odd < 3; ++odd) {
    FatContrast one = bright, all_but_one = saturated;
    double FatContrast::*const member[] = {&FatContrast::skin_to_subcutis, &FatContrast::fat_cv,
                                           &FatContrast::muscle_ratio};
    one.*member[odd] = 3 * saturated.*member[odd];
    all_but_one.*member[odd] = bright.*member[odd];
    EXPECT_EQ(refusal_of(one), "") << odd;
    EXPECT_NE(refusal_of(all_but_one), "") << odd;
  }
  FatContrast behind = bright;
  behind.sternal_thickness = 60;
  EXPECT_EQ(refusal_of(behind), "") << "breasts that touch in front of the sternum";
  behind.wall_seen = 0.4;
  EXPECT_NE(refusal_of(behind), "") << "lung taken for muscle";
  FatContrast thick = bright;
  thick.sternal_thickness = 32;
  thick.wall_seen = 0.53;
  thick.subcutaneous = 0.87;
  EXPECT_EQ(refusal_of(thick), "") << "a thick layer of bright fat over the sternum";
  thick.subcutaneous = 0.73;
  EXPECT_NE(refusal_of(thick), "") << "fat below the skin darker than what lies deeper";
  FatContrast dark = bright;
  dark.subcutaneous = 0.33;
  EXPECT_NE(refusal_of(dark), "") << "fat darker than a third of what surrounds it";
}

TEST(SegmentRobustness, TheOtherBreastAloneInViewIsRefused) {
  for (const bool left : {true, false}) {
    const Volume<float> alone = testing::one_breast(patient().scan, left);
    SegmentOptions other;
    other.side = left ? Side::right : Side::left;
    try {
      run(alone, other);
      ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      const std::string reason = error.what();
      EXPECT_NE(reason.find(left ? "is the left one" : "is the right one"), std::string::npos)
          << reason;
    }
  }
}

TEST(SegmentRobustness, AFieldOfViewThatEndsAtTheTipIsRefused) {
  const Volume<float>& scan = patient().scan;
  const auto& size = scan.grid.size;
  const int tip = int(std::lround(scan.grid.to_index(patient().truth.nipple(1))[0]));
  const std::string reason =
      refusal(testing::cropped(scan, {0, 0, 0}, {tip - 4, size[1] - 1, size[2] - 1}));
  EXPECT_NE(reason.find("ends at the tip of the left breast"), std::string::npos) << reason;
}

TEST(SegmentRobustness, AnArmBesideTheBodyIsLeftOutAndSaid) {
  Volume<float> scan = patient().scan;
  const Grid& grid = scan.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 p = grid.to_patient(Vec3(i, j, k));
        if (std::hypot(p[0], p[1] + 70) < 22) scan.at(i, j, k) += 400;  // between the breasts
      }
    }
  }
  const auto said = [](const Segmentation& result) {
    return std::count_if(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
      return doubt.find("separate from the torso") != std::string::npos;
    });
  };
  EXPECT_EQ(said(patient().base), 0);
  const Segmentation with_arm = run(scan);
  EXPECT_EQ(said(with_arm), 1);
  EXPECT_NEAR(with_arm.beside_ml, 0.001 * std::numbers::pi * 22 * 22 * 38 * 4, 25);
  expect_same(with_arm, 0.97, 0.7, 4);
}

TEST(Quality, FallsBelowOneHalfWhereAReaderHasToLook) {
  const auto score = [](const Segmentation& result, const std::string& stage) {
    for (const StageQuality& quality : quality_of(result)) {
      if (quality.stage == stage) return quality.score;
    }
    ADD_FAILURE() << stage;
    return 0.0;
  };
  const Segmentation& base = patient().base;
  for (const char* stage : {"contrast", "wall", "extent", "tissue"})
    EXPECT_GT(score(base, stage), 0.7) << stage;
  Segmentation worse = base;
  worse.wall_expected_mm = 1.3;
  worse.front_left_out_percent = 13;
  worse.fibroglandular_agreement = 0.4;
  worse.bias_cv_after = 0.09;
  for (const char* stage : {"contrast", "wall", "extent", "tissue"})
    EXPECT_LT(score(worse, stage), least_quality) << stage;
  worse = base;
  worse.breast_expected_dice = 0.92;
  EXPECT_LT(score(worse, "extent"), least_quality);
  worse = base;
  worse.lost_edges_percent = 65;
  EXPECT_LT(score(worse, "tissue"), least_quality);
  worse = base;
  worse.fibroglandular_expected_dice = 0.55;
  EXPECT_LT(score(worse, "tissue"), least_quality);
  worse.wall_expected_mm = std::nan("");
  EXPECT_EQ(score(worse, "wall"), 0);
}

TEST(Quality, ExpectsTheDiceCoefficientOfFractionsAsProbabilities) {
  LabelVolume labels;
  EXPECT_EQ(expected_gland_dice(labels), 1) << "without gland";
  const auto code = [](Tissue tissue) { return static_cast<std::uint8_t>(tissue); };
  labels.tissue = {code(Tissue::fibroglandular), code(Tissue::fibroglandular), code(Tissue::fat),
                   code(Tissue::muscle)};
  labels.fibroglandular_fraction = {1, 0.5, 0.25, 1};
  EXPECT_NEAR(expected_gland_dice(labels), 2 * 1.5 / (2 + 1.75), 1e-6) << "muscle does not count";
}

/// The same patient with another brightness (of fat) of muscle and lung.
Volume<float> with_chest(double brightness) {
  const SyntheticScan& truth = patient().truth;
  Volume<float> scan = patient().scan;
  const Grid& grid = scan.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double signal = truth.signal(grid.to_patient(Vec3(i, j, k)));
        if (signal > 0 && signal < 0.5) scan.at(i, j, k) *= float(brightness / signal);
      }
    }
  }
  return scan;
}

/// Fat that is saturated where it does not show beneath the skin: no wall is found there.
TEST(SegmentRobustness, NoMuscleBehindTheWallIsRefusedOrDoubted) {
  EXPECT_NE(refusal(with_chest(0.85)).find("of the brightness in front"), std::string::npos);
  const auto lung_doubts = [](const Segmentation& result) {
    return std::count_if(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
      return doubt.find("lung") != std::string::npos;
    });
  };
  EXPECT_EQ(lung_doubts(run(with_chest(0.08))), 1);
  EXPECT_EQ(lung_doubts(patient().base), 0);
}

/// Volume found over the true one, on the left, if gland is only strands of this radius (mm) 12 mm
/// apart.
double strands_found(const SyntheticScan& truth, double radius, double brightness) {
  const auto in_strand = [&](const Vec3& p) {
    return truth.in_gland(p) &&
           std::hypot(std::remainder(p[0], 12), std::remainder(p[1], 12)) < radius;
  };
  double volume = 0;  // mm3
  for (double x = 0.5; x < 150; ++x) {
    for (double y = -99.5; y < 60; ++y) {
      for (double z = -73.5; z < 75; ++z) volume += in_strand(Vec3(x, y, z));
    }
  }
  const LabelVolume labels = run(truth.image_of([&](const Vec3& p) {
                               const double signal = truth.signal(p);
                               if (signal != 0.6) return signal;
                               return in_strand(p) ? brightness : 1.0;
                             })).labels;
  double found = 0;
  for (const float fraction : labels.fibroglandular_fraction)
    found += fraction * labels.grid.voxel_volume();
  return found / volume;
}

/// Gland as strands three voxels wide, half as thick as they are apart: most voxels of it are shared
/// with fat. Its fractions add up to its volume however bright it is.
TEST(SegmentRobustness, StrandsOfGlandKeepTheirVolume) {
  for (const double brightness : {0.35, 0.55, 0.7}) {
    EXPECT_NEAR(strands_found(patient().truth, 3.4, brightness), 1, 0.06)
        << "gland " << brightness << " as bright as fat";
  }
}

/// A seventh of the breast, almost as bright as its fat: a fifth of it was lost to the estimate of the
/// coil's sensitivity.
TEST(SegmentRobustness, MuchBrightGlandIsNotTakenForFat) {
  SyntheticScan truth;
  truth.gland_scale = 0.65;
  EXPECT_NEAR(strands_found(truth, 4.2, 0.7), 1, 0.08);
}

TEST(SegmentRobustness, EmptyVolumeIsRefused) {
  EXPECT_NE(refusal(Volume<float>(patient().scan.grid)), "");
}

TEST(SegmentRobustness, SigmaCoversTheWallsError) {
  const SyntheticScan& truth = patient().truth;
  const TriMesh& points = patient().base.points;
  const auto &surface = points.point_data.at("surface"), &sigma = points.point_data.at("sigma_mm");
  double within = 0, count = 0;
  for (std::size_t n = 0; n < surface.size(); ++n) {
    const Vec3& p = points.points[n];
    if (surface[n] != 1 || !truth.in_ellipsoid(Vec3(p[0], truth.wall(p[0], p[2]) - 1, p[2]), 0.9))
      continue;
    within += std::abs(p[1] - truth.wall(p[0], p[2])) < 2 * sigma[n];
    count += 1;
  }
  EXPECT_GT(within / count, 0.95);
  EXPECT_LT(patient().base.wall_sigma_mean, 3) << "a sigma that covers everything says nothing";
}

TEST(SegmentRobustness, ShiftMovesTheWallByItsSigma) {
  SegmentOptions options;
  options.wall_shift = 1;
  const Segmentation moved = run(patient().scan, options);
  const WallDistance wall = compare_walls(moved.labels, patient().base.labels);
  EXPECT_NEAR(wall.bias_mm, moved.wall_sigma_mean, 0.5 * moved.wall_sigma_mean + 0.3);
  EXPECT_GT(wall.bias_mm, 0.3);
}

}  // namespace
}  // namespace breast
