// Anatomies a breast scan comes with: neck and upper chest, implants, arms, breasts that touch what
// is beside them. Each ends right, or with one clear line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "evaluation/overlap.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "segment/quality.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

using testing::ScanWithNeck;
using testing::SyntheticScan;

Segmentation run(const Volume<float>& scan) {
  Timer timer;
  return segment_breast(scan, {}, no_progress(), timer);
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

}  // namespace
}  // namespace breast
