// SPDX-License-Identifier: GPL-3.0-or-later
// One patient in the contrasts of breast MR: the same breast, or a refusal that names the contrast.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "evaluation/overlap.hpp"
#include "evaluation/wall_distance.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "segment/contrast/dixon.hpp"
#include "segment/segment.hpp"
#include "surface/rigid_motion.hpp"

namespace breast {
namespace {

using testing::SyntheticScan;

/// Water and fat of a Dixon scan of the patient, whose sum is her T1-weighted scan, and a scan with
/// suppressed fat.
struct Patient {
  SyntheticScan truth = SyntheticScan::coarse();
  Volume<float> water, fat, t1, suppressed;

  Patient() {
    water = truth.image_of([&](const Vec3& p) { return truth.signal(p) * (1 - fat_at(p)); }, 2);
    fat = truth.image_of([&](const Vec3& p) { return truth.signal(p) * fat_at(p); }, 3);
    t1 = truth.image(4);
    suppressed = truth.image_of([&](const Vec3& p) { return suppressed_at(p); }, 5);
  }
  /// Muscle is little brighter than fat.
  double suppressed_at(const Vec3& p) const { return suppressed_at(p, 0.35); }
  double suppressed_at(const Vec3& p, double muscle) const {
    const double signal = truth.signal(p);
    const bool on_chest = p[1] < truth.wall(p[0], p[2]) - truth.fat_layer + 3;
    const bool skin = truth.in_skin(p, 3) || (on_chest && !truth.in_ellipsoid(p, 1));
    if (signal > 0 && skin) return 0.8;
    return signal == 1 ? 0.3 : signal == 0.6 ? 0.9 : signal == 0.35 ? muscle : signal;
  }
  double fat_at(const Vec3& p) const {
    return truth.in_skin(p, 3) || truth.signal(p) < 1 ? 0.1 : 0.95;
  }
};

const Patient& patient() {
  static const Patient one;
  return one;
}

Segmentation run(const Volume<float>& scan, const SegmentOptions& options = {}) {
  Timer timer;
  return segment_breast(scan, options, no_progress(), timer);
}

const Segmentation& as_t1() {
  static const Segmentation result = run(patient().t1);
  return result;
}

Segmentation dixon(const Volume<float>& water, const Volume<float>& fat) {
  SegmentOptions options;
  options.fat = fat;
  return run(water, options);
}

std::string refusal(const Volume<float>& scan, const SegmentOptions& options = {}) {
  try {
    run(scan, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    return error.what();
  }
  return "accepted";
}

/// A refusal states what to try, once.
void expect_one_list_of_ways_out(const std::string& reason) {
  const std::string list = ": give ";
  const std::size_t first = reason.find(list);
  EXPECT_NE(first, std::string::npos) << reason;
  EXPECT_EQ(reason.rfind(list), first) << reason;
}

double gland_ml(const Segmentation& result) {
  double sum = 0;
  for (const float share : result.labels.fibroglandular_fraction) sum += share;
  return sum * result.labels.grid.voxel_volume() / 1000;
}

void expect_as_t1(const Segmentation& result) {
  EXPECT_EQ(result.kind, Contrast::dixon);
  EXPECT_GT(compare_labels(result.labels, as_t1().labels).breast.dice, 0.98);
  EXPECT_LT(compare_walls(result.labels, as_t1().labels).distance.mean_mm, 0.5);
  EXPECT_LT((result.labels.landmarks.at("nipple") - as_t1().labels.landmarks.at("nipple")).norm(),
            4);
  EXPECT_NEAR(gland_ml(result), gland_ml(as_t1()), 0.15 * gland_ml(as_t1()));
}

TEST(Dixon, WaterAndFatGiveTheBreastOfT1) {
  const Segmentation result = dixon(patient().water, patient().fat);
  expect_as_t1(result);
  EXPECT_LT(result.exchanged_percent, 1);
}

TEST(Dixon, ExchangedRegionsArePutRightAndSaid) {
  // The scanner took the lower half of the left breast's water for fat.
  Patient exchanged = patient();
  double breast = 0, turned = 0;
  const Grid& grid = exchanged.truth.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 p = grid.to_patient(Vec3(i, j, k));
        const bool inside = p[0] > 0 && exchanged.truth.in_ellipsoid(p, 1);
        breast += inside;
        if (!(p[0] > 20 && p[2] < 0)) continue;
        turned += inside;
        std::swap(exchanged.water.at(i, j, k), exchanged.fat.at(i, j, k));
      }
    }
  }
  const Segmentation result = dixon(exchanged.water, exchanged.fat);
  expect_as_t1(result);
  EXPECT_NEAR(result.exchanged_percent, 100 * turned / breast, 8);
  EXPECT_TRUE(std::any_of(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
    return doubt.find("water and fat are exchanged in") == 0;
  }));
}

TEST(Dixon, TheTwoFilesInTheOtherOrderGiveTheSame) {
  const Segmentation result = dixon(patient().fat, patient().water);
  expect_as_t1(result);
  EXPECT_GT(result.exchanged_percent, 95);
}

TEST(Dixon, WaterOrFatAloneIsRefusedByName) {
  for (const Volume<float>* half : {&patient().water, &patient().fat}) {
    const std::string reason = refusal(*half);
    EXPECT_NE(reason.find("of a Dixon scan alone"), std::string::npos) << reason;
    EXPECT_NE(reason.find("--fat"), std::string::npos) << reason;
    expect_one_list_of_ways_out(reason);
  }
  SegmentOptions options;
  options.contrast = Contrast::dixon;
  EXPECT_NE(refusal(patient().water, options).find("fat image"), std::string::npos);
}

TEST(Dixon, ImagesThatAreNotWaterAndFatOfOneScanAreRefused) {
  SegmentOptions options;
  for (const Volume<float>* other : {&patient().water, &patient().t1}) {
    options.fat = *other;
    const std::string reason = refusal(*other, options);
    EXPECT_NE(reason, "accepted");
  }
  options.fat = patient().water;
  const std::string in_phase = refusal(patient().t1, options);
  EXPECT_NE(in_phase.find("not water and fat of one scan"), std::string::npos) << in_phase;
  options.fat->grid.origin[2] += 2;
  const std::string moved = refusal(patient().fat, options);
  EXPECT_NE(moved.find("give the two images of one Dixon scan"), std::string::npos) << moved;
}

Volume<float> suppressed_beside_bright_muscle() {
  return patient().truth.image_of([](const Vec3& p) { return patient().suppressed_at(p, 0.6); }, 7);
}

SegmentOptions as_suppressed() {
  SegmentOptions options;
  options.contrast = Contrast::fat_suppressed;
  return options;
}

TEST(Suppressed, MuscleTwiceAsBrightShowsTheWall) {
  const Segmentation result = run(suppressed_beside_bright_muscle(), as_suppressed());
  EXPECT_EQ(result.kind, Contrast::fat_suppressed);
  EXPECT_NEAR(result.muscle_over_fat, 2, 0.3);
  EXPECT_EQ(result.unsuppressed_ml, 0);
  EXPECT_GT(compare_labels(result.labels, as_t1().labels).breast.dice, 0.95);
  EXPECT_LT(compare_walls(result.labels, as_t1().labels).distance.mean_mm, 2);
  EXPECT_NEAR(gland_ml(result), gland_ml(as_t1()), 0.15 * gland_ml(as_t1()));
  EXPECT_LT((result.labels.landmarks.at("nipple") - as_t1().labels.landmarks.at("nipple")).norm(),
            6);
}

/// Muscle twice as bright as suppressed fat, which is not suppressed within 25 mm of a place of the breast.
Volume<float> failed_at(const Vec3& centre) {
  return patient().truth.image_of(
      [&](const Vec3& p) {
        const double signal = patient().suppressed_at(p, 0.6);
        return (p - centre).norm() < 25 && signal == 0.3 ? 1.2 : signal;
      },
      7);
}

// Where suppression fails at the lateral border of the breast, this wall cannot be read; if it is one day, the
// place has to be flagged.
TEST(Suppressed, FailedSuppressionIsFlaggedOrRefusedSaidOrNot) {
  const SyntheticScan& truth = patient().truth;
  const double x = truth.half_width + 0.75 * truth.radius;
  const Volume<float> failed = failed_at(Vec3(x, truth.wall(x, 0) - 0.3 * truth.depth, 0));
  for (const SegmentOptions& options : {as_suppressed(), SegmentOptions{}}) {
    try {
      const Segmentation result = run(failed, options);
      EXPECT_EQ(result.kind, Contrast::fat_suppressed);
      EXPECT_GT(result.unsuppressed_ml, 10);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("--also"), std::string::npos) << error.what();
      expect_one_list_of_ways_out(error.what());
    }
  }
}

TEST(Suppressed, MuscleLittleBrighterIsRefusedWithTheNumberAndTheWaysOut) {
  const std::string reason = refusal(patient().suppressed, as_suppressed());
  for (const char* words : {"times as bright as fat (at least 1.2", "--chest-wall", "--also"})
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
  expect_one_list_of_ways_out(reason);
}

TEST(Suppressed, WhatIsNoneOfItIsRefused) {
  for (const Volume<float>* other : {&patient().t1, &patient().water, &patient().fat})
    EXPECT_NE(refusal(*other, as_suppressed()), "accepted");
}

TEST(Suppressed, IsFoundWithoutBeingSaid) {
  const Volume<float> scan = suppressed_beside_bright_muscle();
  const Segmentation found = run(scan), said = run(scan, as_suppressed());
  EXPECT_EQ(found.kind, Contrast::fat_suppressed);
  EXPECT_EQ(found.labels.tissue, said.labels.tissue);
  EXPECT_TRUE(std::any_of(found.doubts.begin(), found.doubts.end(), [](const std::string& doubt) {
    return doubt.find("the chest wall was found in suppressed fat") == 0;
  }));
}

TEST(Suppressed, FoundOrSaidItIsRefusedByTheSameNumber) {
  const std::string reason = refusal(patient().suppressed);
  for (const char* words : {"fat is saturated", "; as a scan with suppressed fat: muscle is ",
                            "(at least 1.2 needed", "--chest-wall", "--also"})
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
  expect_one_list_of_ways_out(reason);
}

TEST(Suppressed, AGivenWallIsTheWayOut) {
  SegmentOptions options;
  const SyntheticScan& truth = patient().truth;
  options.wall_points_of_surface = true;
  for (double x = 5; x < 150; x += 5)
    for (double z = -70; z < 70; z += 5) options.wall_points.emplace_back(x, truth.wall(x, z), z);
  const Segmentation result = run(patient().suppressed, options);
  EXPECT_EQ(result.kind, Contrast::fat_suppressed);
  EXPECT_GT(compare_labels(result.labels, as_t1().labels).breast.dice, 0.95);
  EXPECT_TRUE(std::any_of(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
    return doubt.find("the chest wall is the given one: muscle is ") == 0;
  }));
}

Segmentation with_second(const Volume<float>& first, const Volume<float>& second) {
  SegmentOptions options;
  options.also = second;
  return run(first, options);
}

void expect_by_second(const Segmentation& result, double nipple_mm) {
  EXPECT_TRUE(result.also.used);
  EXPECT_LT(result.also.residual_mm, 4);
  EXPECT_NE(result.also.change.find("are from the second scan"), std::string::npos);
  const auto same = compare_labels(result.labels, as_t1().labels);
  EXPECT_GT(same.breast.dice, 0.95);
  // A third of a voxel of 3 mm all over the skin is a tenth.
  EXPECT_NEAR(same.breast.given_ml, same.breast.truth_ml, 0.1 * same.breast.truth_ml);
  EXPECT_LT(compare_walls(result.labels, as_t1().labels).distance.mean_mm, 1);
  EXPECT_LT((result.labels.landmarks.at("nipple") - as_t1().labels.landmarks.at("nipple")).norm(),
            nipple_mm);
}

TEST(SecondScan, ShowsTheWallThatSuppressedFatHides) {
  EXPECT_NE(refusal(patient().suppressed), "accepted");
  const Segmentation result = with_second(patient().suppressed, patient().t1);
  expect_by_second(result, 6);
  EXPECT_EQ(result.also.shift_mm, 0) << "one frame";
}

TEST(SecondScan, IsAlignedWithTheFirst) {
  // She moved between the two.
  const RigidMotion motion{Vec3(0, 0, 0), Vec3(7, -9, 8), Vec3(1, 0, 3)};
  const SyntheticScan& truth = patient().truth;
  const Volume<float> second =
      truth.image_of([&](const Vec3& p) { return truth.signal(motion.origin_of(p)); }, 6);
  const Segmentation result = with_second(patient().suppressed, second);
  expect_by_second(result, 15);  // a smooth dome, of which one voxel in front decides
  EXPECT_GT(result.also.shift_mm, 5);
}

TEST(SecondScan, OfAnotherBodyIsRefused) {
  SyntheticScan other = patient().truth;
  other.depth = 45;
  SegmentOptions options;
  options.also = other.image();
  const std::string reason = refusal(patient().suppressed, options);
  EXPECT_NE(reason.find("the skins of the two scans are"), std::string::npos) << reason;
  options.also = patient().suppressed;
  const std::string both = refusal(patient().suppressed, options);
  EXPECT_NE(both.find("; --also: "), std::string::npos) << both;
}

TEST(SecondScan, ChangesNothingWhereTheFirstShowsTheWall) {
  const Segmentation result = with_second(patient().t1, patient().suppressed);
  EXPECT_FALSE(result.also.used);
  EXPECT_NE(result.also.change.find("changed nothing"), std::string::npos);
  EXPECT_EQ(result.labels.tissue, as_t1().labels.tissue);
}

TEST(Contrast, MuscleAsBrightAsFatIsRefused) {
  // Lung would be taken for the muscle behind the wall.
  const SyntheticScan& truth = patient().truth;
  const Volume<float> scan = truth.image_of([&](const Vec3& p) {
    const double signal = truth.signal(p);
    return signal == 0.35 ? 0.6 : signal == 0.6 ? 0.8 : signal == 1 ? 0.6 : signal;
  });
  EXPECT_NE(refusal(scan).find("fat is saturated"), std::string::npos) << refusal(scan);
}

}  // namespace
}  // namespace breast
