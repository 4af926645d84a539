// SPDX-License-Identifier: GPL-3.0-or-later
// Anatomies a breast scan comes with: neck and upper chest, implants, arms, breasts that touch what
// is beside them. Each ends right, or with one clear line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "evaluation/overlap.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "segment/quality.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

using testing::ScanOfRoundChest;
using testing::ScanWithNeck;
using testing::SyntheticScan;

Segmentation run(const Volume<float>& scan) {
  Timer timer;
  return segment_breast(scan, {}, no_progress(), timer);
}

bool doubted(const Segmentation& result, const std::string& words) {
  return std::any_of(result.doubts.begin(), result.doubts.end(), [&](const std::string& doubt) {
    return doubt.find(words) != std::string::npos;
  });
}

/// Highest voxel labelled breast, patient z (mm).
double cranial_end(const LabelVolume& labels) {
  double end = -1e9;
  for (int k = 0; k < labels.grid.size[2]; ++k) {
    for (int j = 0; j < labels.grid.size[1]; ++j) {
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        if (is_breast(Tissue(labels.tissue[labels.grid.offset(i, j, k)])))
          end = std::max(end, labels.grid.to_patient(Vec3(i, j, k))[2]);
      }
    }
  }
  return end;
}

/// Mean and largest distance (mm) along the columns from the truth to the first muscle, of columns
/// between 70 and 120 mm left of the midline, clear of the neck, and above `from`.
std::array<double, 2> wall_error(const LabelVolume& labels, const SyntheticScan& truth,
                                 double from) {
  double sum = 0, most = 0, count = 0;
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      const Vec3 at = grid.to_patient(Vec3(i, 0, k));
      if (at[0] < 70 || at[0] > 120 || at[2] < from) continue;
      int j = 0;
      while (j < grid.size[1] &&
             labels.tissue[grid.offset(i, j, k)] != std::uint8_t(Tissue::muscle))
        ++j;
      const double error =
          std::abs(grid.to_patient(Vec3(i, j - 0.5, k))[1] - truth.wall(at[0], at[2]));
      sum += error, count += 1;
      most = std::max(most, error);
    }
  }
  return {sum / count, most};
}

/// Where the midline's skin falls back to the neck the chest wall beside it stays where it is.
TEST(Neck, ChestWallAboveTheSternalNotch) {
  ScanWithNeck truth;
  truth.notch = 50;
  const Segmentation result = run(truth.image());
  const auto [mean, most] = wall_error(result.labels, truth, 60);
  EXPECT_LT(mean, 1.5);
  EXPECT_LT(most, 6);
}

/// Covered 24 mm thick up to the clavicle, where a breast elsewhere ends at 16 mm.
TEST(Neck, BreastEndsBelowAThickUpperChest) {
  ScanWithNeck truth;
  truth.cover = 24;
  const Segmentation result = run(truth.image());
  EXPECT_GT(cranial_end(result.labels), SyntheticScan::radius - 15);
  EXPECT_LT(cranial_end(result.labels), SyntheticScan::radius + 22);
  EXPECT_LT(wall_error(result.labels, truth, 60)[0], 2);
}

/// Volumes of the left breast (ml): true, found, and common to both.
struct Volumes {
  double truth = 0, found = 0, common = 0;
};

Volumes volumes_of(const ScanOfRoundChest& truth) {
  const LabelVolume labels = run(truth.image()).labels;
  const auto found_at = [&](const Vec3& p) {
    const Vec3 at = labels.grid.to_index(p);
    const std::array<int, 3> n{int(std::lround(at[0])), int(std::lround(at[1])),
                               int(std::lround(at[2]))};
    return labels.grid.contains(n[0], n[1], n[2]) &&
           is_breast(Tissue(labels.tissue[labels.grid.offset(n[0], n[1], n[2])]));
  };
  Volumes volumes;
  const double ml = truth.grid.voxel_volume() / mm3_per_ml;
  for (int k = 0; k < truth.grid.size[2]; ++k) {
    for (int j = 0; j < truth.grid.size[1]; ++j) {
      for (int i = 0; i < truth.grid.size[0]; ++i) {
        const Vec3 p = truth.grid.to_patient(Vec3(i, j, k));
        const bool is = p[0] > 0 && truth.in_breast(p), found = found_at(p);
        volumes.truth += is * ml;
        volumes.found += found * ml;
        volumes.common += (is && found) * ml;
      }
    }
  }
  return volumes;
}

void expect_whole(const Volumes& volumes) {
  EXPECT_NEAR(volumes.found / volumes.truth, 1, 0.02);
  EXPECT_GT(2 * volumes.common / (volumes.found + volumes.truth), 0.95);
}

/// Thickest 125 mm beside the midline, where the wall falls back by 35 degrees and more: a column at
/// the end of what it covers would cut off an eighth of it.
TEST(Extent, BreastAtTheSideOfABroadChest) {
  ScanOfRoundChest truth;
  truth.centre = 125;
  truth.half_chest = 185;
  expect_whole(volumes_of(truth));
}

/// Hangs up to 32 mm below the fold under it.
TEST(Extent, BreastThatHangsOverItsFold) {
  ScanOfRoundChest truth;
  truth.sag = 1;
  expect_whole(volumes_of(truth));
}

/// Both at once.
TEST(Extent, BreastAtTheSideThatHangsOver) {
  ScanOfRoundChest truth;
  truth.centre = 125;
  truth.half_chest = 185;
  truth.sag = 0.6;
  expect_whole(volumes_of(truth));
}

struct Judged {
  double dice = 0;  ///< of the breast, with that of the unchanged scan
  bool flagged = false;
  std::string refusal;
};

Judged judged(const Volume<float>& scan, const Segmentation& base) {
  Judged found;
  try {
    const Segmentation result = run(scan);
    found.dice = compare_labels(result.labels, base.labels).breast.dice;
    found.flagged = !result.doubts.empty();
    for (const StageQuality& quality : quality_of(result))
      found.flagged |= quality.score < least_quality;
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2) << error.what();
    found.refusal = error.what();
    EXPECT_EQ(found.refusal.find('\n'), std::string::npos);
  }
  return found;
}

void expect_right_or_said(const Volume<float>& scan, const Segmentation& base,
                          const std::string& what) {
  const Judged found = judged(scan, base);
  EXPECT_TRUE(found.dice > 0.93 || found.flagged || !found.refusal.empty())
      << what << ": breast Dice " << found.dice << " and nothing said";
}

/// A bag of silicone or salt water, 40 mm across and 28 deep to either side, 10 mm before the wall.
TEST(Implant, IsSaidWhateverItsBrightness) {
  SyntheticScan truth;
  truth.gland_scale = 0.25;
  EXPECT_FALSE(doubted(run(truth.image()), "implant"));
  const Vec3 centre(truth.half_width, truth.wall(truth.half_width, 0) - 38, 0);
  for (const double brightness : {0.06, 0.2, 0.45}) {
    const Volume<float> scan = truth.image_of([&](const Vec3& p) {
      const Vec3 d = p - centre;
      const bool inside = std::hypot(d[0] / 40, d[1] / 28, d[2] / 40) < 1;
      return inside ? brightness : truth.signal(p);
    });
    EXPECT_TRUE(doubted(run(scan), "an implant")) << brightness << " of the brightness of fat";
  }
}

/// An arm of fat about muscle: clear of the breast it is left out, touching it is left out or said.
TEST(Arm, IsLeftOutOrSaid) {
  const SyntheticScan truth;
  const Segmentation base = run(truth.image());
  struct Arm {
    double x, y, radius;
  };
  for (const Arm& arm : {Arm{128, 0, 24}, Arm{128, -25, 30}, Arm{135, -60, 20}, Arm{0, -20, 25}}) {
    const auto scan = truth.image_of([&](const Vec3& p) {
      const double signal = truth.signal(p), off = std::hypot(p[0] - arm.x, p[1] - arm.y);
      return signal > 0 || off > arm.radius ? signal : off > arm.radius - 8 ? 1.0 : 0.35;
    });
    expect_right_or_said(scan, base, message("arm at ", arm.x, ", ", arm.y));
  }
}

/// Ghosts and noise of the air that are brighter than half of muscle, but not than half of the dimmest skin.
TEST(Haze, OfTheAirBesideTheBodyIsNoBody) {
  const ScanOfRoundChest truth;
  Volume<float> scan = truth.image();
  const Segmentation clear = run(scan);
  const Grid& grid = scan.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Vec3 p = grid.to_patient(Vec3(i, j, k));
        const double haze = 35 + 8 * std::sin(p[0] / 12) * std::sin(p[1] / 9),
                     fade = std::clamp((70 - p[1]) / 40, 0.0, 1.0);
        if (truth.signal(p) == 0 && p[1] > -60) scan.at(i, j, k) += float(fade * haze);
      }
    }
  }
  const Segmentation hazy = run(scan);
  EXPECT_LT(hazy.contrast.silent_share, 0.01);
  EXPECT_GT(compare_labels(hazy.labels, clear.labels).breast.dice, 0.97);
}

/// A bridge of skin folds between the breasts closes a handle round the cleft: the body's surface
/// is no longer a disc.
TEST(Handle, BreastsThatTouchAreRightOrSaid) {
  const SyntheticScan truth;
  const Segmentation base = run(truth.image());
  const auto scan = truth.image_of([&](const Vec3& p) {
    const bool bridge = std::abs(p[0]) < 40 && std::hypot(p[1] + 20, p[2]) < 12;
    return bridge && truth.signal(p) == 0 ? 1.0 : truth.signal(p);
  });
  expect_right_or_said(scan, base, "bridge between the breasts");
}

}  // namespace
}  // namespace breast
