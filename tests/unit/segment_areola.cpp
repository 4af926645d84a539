// SPDX-License-Identifier: GPL-3.0-or-later
// Breasts without a papilla: the areola that their skin shows, or none.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fixtures/synthetic_scan.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

using testing::SyntheticScan;

/// The front of the left breast at a place beside its most anterior point.
Vec3 on_skin(const SyntheticScan& scan, double aside, double up) {
  const double share = std::hypot(aside, up) / scan.radius;
  return scan.nipple(1) + Vec3(aside, scan.depth * (1 - std::sqrt(1 - share * share)), up);
}

/// A smooth breast in skin of 1.5 mm, with round patches of thicker skin.
struct ScanWithSkin : SyntheticScan {
  struct Patch {
    double aside = 0, up = 0, radius = 18;  ///< mm, of the left breast from its front
    double thickness = 5;                   ///< mm
  };
  std::vector<Patch> patches;

  explicit ScanWithSkin(double slices = 3) {
    grid.size[2] = int(152 / slices);
    grid.spacing[2] = slices;
    grid.origin[2] = -0.5 * (grid.size[2] - 1) * slices;
  }

  double thickness(const Vec3& p) const {
    const Vec3 on_left(std::abs(p[0]), p[1], p[2]);
    for (const Patch& patch : patches)
      if ((on_left - on_skin(*this, patch.aside, patch.up)).norm() < patch.radius)
        return patch.thickness;
    return 1.5;
  }
  Volume<float> image() const {
    return image_of([this](const Vec3& p) {
      const double side = p[0] > 0 ? half_width : -half_width;
      const double forward = wall(side, 0) - p[1];
      // Along the normal of the ellipsoid.
      const Vec3 slope((p[0] - side) / (radius * radius), -forward / (depth * depth),
                       p[2] / (radius * radius));
      const double scaled = std::hypot((p[0] - side) / radius, forward / depth, p[2] / radius);
      const double below = scaled > 0 ? (1 - scaled) * scaled / slope.norm() : depth;
      const bool skin = !behind_wall(p) && below < thickness(p);
      return signal(p) > 0 && skin ? 0.5 : signal(p);
    });
  }
};

Segmentation segmented(const ScanWithSkin& scan, Side side) {
  SegmentOptions options;
  options.side = side;
  Timer timer;
  return segment_breast(scan.image(), options, no_progress(), timer);
}

std::string about_nipple(const Segmentation& result) {
  for (const std::string& doubt : result.doubts)
    if (doubt.find("taken for the nipple") != std::string::npos) return doubt;
  return "";
}

TEST(Areola, BesideTheMostAnteriorPointIsTakenForTheNippleAndSaid) {
  ScanWithSkin scan;
  scan.patches = {{22, -12}};
  const Segmentation left = segmented(scan, Side::left), right = segmented(scan, Side::right);
  const Vec3 nipple = left.labels.landmarks.at("nipple"),
             mirrored = right.labels.landmarks.at("nipple").cwiseProduct(Vec3(-1, 1, 1));
  EXPECT_EQ(left.papilla_height, 0);
  EXPECT_LT((nipple - on_skin(scan, 22, -12)).norm(), 4);
  EXPECT_LT((nipple - mirrored).norm(), 1);
  EXPECT_GT(left.nipple_from_extreme, 20);
  EXPECT_NE(about_nipple(left).find("areola"), std::string::npos) << about_nipple(left);
}

TEST(Areola, OfEvenSkinIsNoneAndTheMostAnteriorPointIsTaken) {
  const ScanWithSkin scan;
  const Segmentation result = segmented(scan, Side::left);
  EXPECT_FALSE(result.areola.found) << result.areola.excess << " " << result.areola.elsewhere;
  EXPECT_LT((result.labels.landmarks.at("nipple") - scan.nipple(1)).norm(), 6);
  EXPECT_NE(about_nipple(result).find("the most anterior point of the smoothed skin is taken"),
            std::string::npos)
      << about_nipple(result);
}

TEST(Areola, IsNotWhereGlandTouchesTheSkin) {
  ScanWithSkin scan;
  scan.patches = {{22, -12, 18, 14}};
  const Segmentation result = segmented(scan, Side::left);
  EXPECT_GT(result.areola.excess, 0.5);
  EXPECT_FALSE(result.areola.found) << result.areola.behind;
  EXPECT_LT((result.labels.landmarks.at("nipple") - scan.nipple(1)).norm(), 6);
}

TEST(Areola, IsNotSoughtInThickSlices) {
  ScanWithSkin scan(5);
  scan.patches = {{22, -12}};
  const Segmentation result = segmented(scan, Side::left);
  EXPECT_FALSE(result.areola.found);
  EXPECT_NE(about_nipple(result).find("most anterior point"), std::string::npos);
}

// Two such places cannot be told apart.
TEST(Areola, OfTwoAlikeNeitherIsTaken) {
  ScanWithSkin scan;
  scan.patches = {{25, 0, 14}, {-25, 0, 14}};
  const Segmentation result = segmented(scan, Side::left);
  EXPECT_FALSE(result.areola.found) << result.areola.excess << " " << result.areola.elsewhere;
  EXPECT_LT((result.labels.landmarks.at("nipple") - scan.nipple(1)).norm(), 6);
}

}  // namespace
}  // namespace breast
