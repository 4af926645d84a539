// SPDX-License-Identifier: GPL-3.0-or-later
// CC to MLO: straight for affine deformations, the material point's image
// for any, measured as said.
#include "matching/correspondence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/squashed.hpp"
#include "mesh/locate.hpp"
#include "meshing/body_mesh.hpp"

using namespace breast;
using namespace breast::fixtures;

namespace {

HexMesh breast_with_landmarks() {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  mesh.reference = mesh.imaged;
  const Locator locator(mesh, mesh.imaged);
  const auto add = [&](const std::string& name, const Vec3& at) {
    const Location found = locator.nearest(at);
    mesh.landmarks.push_back({name, at, found.element, found.local, found.moved});
  };
  add("tumour", Vec3(6, 30, 9));
  add("nipple", Vec3(0, 0, 0));
  return mesh;
}

const HexMesh& body() {
  static const HexMesh mesh = breast_with_landmarks();
  return mesh;
}

// Squash with bending: x and y shears that depend on the other coordinates keep the volume.
HexMesh bent(View view) {
  const HexMesh flat = squashed(body(), view, 0.6);
  HexMesh mesh = flat;
  for (Vec3& x : mesh.points) {
    x.x() += 4 * std::sin(x.z() / 12);
    x.y() += 3 * std::sin(x.z() / 15);  // otherwise u is constant along the column
  }
  add_contact(mesh, view);
  return mesh;
}

}  // namespace

TEST(Correspondence, AnAffineDeformationGivesAStraightCurve) {
  const HexMesh cc = squashed(body(), View::cc, 0.5), mlo = squashed(body(), View::mlo, 0.6);
  const Matcher matcher(cc, mlo);
  const MatchedCurve curve = matcher.match(*matcher.from_landmark("tumour"));
  ASSERT_FALSE(curve.in_air());
  EXPECT_GE(curve.points.size(), 64u);
  EXPECT_LT(curve.max_deviation, 1e-9);
  EXPECT_NEAR(curve.length, curve.chord, 1e-9);
  EXPECT_GT(curve.length, 10);
  // The projected landmark lies on it (its ray passes a millionth of a millimetre beside).
  EXPECT_LT(distance_to_curve(curve, *matcher.to_landmark("tumour")), 2e-6);
  EXPECT_FALSE(curve.through_back);
}

TEST(Correspondence, EveryPointIsTheSameMaterialInEveryShape) {
  const HexMesh cc = bent(View::cc), mlo = bent(View::mlo);
  const Matcher matcher(cc, mlo);
  const MatchedCurve curve = matcher.match(*matcher.from_landmark("tumour"));
  const Locator in_cc(cc, cc.points), in_mlo(mlo, mlo.points), in_imaged(cc, cc.imaged);
  for (std::size_t i = 0; i < curve.points.size(); i += 5) {
    const ColumnPoint& point = curve.points[i];
    // Onto the CC pixel ...
    EXPECT_LT((matcher.from_frame().pose.project(point.from) - curve.from_uv).norm(), 2e-6);
    // ... and back: found again in the other shapes, it is the same point of the first.
    const Location a = in_mlo.nearest(point.to), b = in_imaged.nearest(point.imaged);
    EXPECT_LT((element_position(cc, cc.points, a.element, a.local) - point.from).norm(), 1e-6);
    EXPECT_LT((element_position(cc, cc.points, b.element, b.local) - point.from).norm(), 1e-6);
    EXPECT_EQ(matcher.to_frame().pose.project(point.to), point.to_uv);
  }
  // And from MLO to CC: the projection of an MLO curve's points contains the CC pixel.
  EXPECT_LT(distance_to_curve(curve, *matcher.to_landmark("tumour")), 2e-3);
}

TEST(Correspondence, DepthRunsThroughTheColumnOnce) {
  const HexMesh cc = bent(View::cc), mlo = bent(View::mlo);
  const Matcher matcher(cc, mlo);
  const MatchedCurve curve = matcher.match(*matcher.from_landmark("tumour"));
  EXPECT_NEAR(curve.points.front().depth, 0, 1e-9);
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    EXPECT_GT(curve.points[i].depth, curve.points[i - 1].depth);
    const double step = (curve.points[i].from - curve.points[i - 1].from).norm();
    EXPECT_NEAR(curve.points[i].depth - curve.points[i - 1].depth, step, 1e-6);
    // From the paddle to the detector.
    EXPECT_GT((curve.points[i].from - curve.points[i - 1].from).dot(matcher.from_frame().pose.n),
              0);
  }
}

TEST(Correspondence, TheCurveIsSampledToItsTolerance) {
  const HexMesh cc = bent(View::cc), mlo = bent(View::mlo);
  const Matcher matcher(cc, mlo);
  const Vec2 at = *matcher.from_landmark("tumour") + Vec2(4, 7);
  const MatchedCurve coarse = matcher.match(at, 0.05), fine = matcher.match(at, 0.001);
  EXPECT_GT(fine.points.size(), coarse.points.size());
  for (const ColumnPoint& point : fine.points) {
    EXPECT_LT(distance_to_curve(coarse, point.to_uv), 0.05);
  }
  EXPECT_GT(fine.max_deviation, 0.5);  // this one is bent
  EXPECT_GT(fine.length, fine.chord);
}

// Without compression the column is what the CC map's inverse makes of a straight line.
TEST(Correspondence, TheStressFreeColumnsBendIsThatOfTheInverseMap) {
  const HexMesh straight = squashed(body(), View::cc, 0.5), mlo = bent(View::mlo),
                cc = bent(View::cc);
  const Matcher affine(straight, mlo), curved(cc, mlo);
  const MatchedCurve line = affine.match(*affine.from_landmark("tumour"));
  EXPECT_LT(line.reference_deviation, 1e-6);
  EXPECT_GT(line.max_deviation, 0.5);  // bent by the second compression alone
  const MatchedCurve curve = curved.match(*curved.from_landmark("tumour"));
  const double across = 1 / std::sqrt(0.6);
  const auto reference = [&](double z) {  // of the column's point at height z, up to a constant
    return Vec3(-4 * std::sin(z / 12) / across, -3 * std::sin(z / 15) / across, z / 0.6);
  };
  const double top = curve.points.front().from.z(), bottom = curve.points.back().from.z();
  const Vec3 a = reference(top), d = (reference(bottom) - a).normalized();
  double expected = 0;
  for (int k = 0; k <= 200; ++k) {
    const Vec3 x = reference(top + (bottom - top) * k / 200) - a;
    expected = std::max(expected, (x - x.dot(d) * d).norm());
  }
  EXPECT_GT(expected, 0.5);
  EXPECT_NEAR(curve.reference_deviation, expected, 0.25 * expected);  // eight elements interpolate
}

TEST(Correspondence, TheArcKeepsTheDistanceFromTheNipple) {
  const HexMesh cc = bent(View::cc), mlo = bent(View::mlo);
  const Matcher matcher(cc, mlo);
  const Vec2 tumour = *matcher.from_landmark("tumour");
  const double radius = matcher.nipple_distance(tumour);
  EXPECT_NEAR(radius, (tumour - *matcher.from_landmark("nipple")).norm(), 1e-12);
  const auto arc = matcher.nipple_arc(tumour);
  ASSERT_FALSE(arc.empty());
  int points = 0;
  for (const auto& stretch : arc) {
    for (const Vec2& uv : stretch) {
      EXPECT_NEAR((uv - *matcher.to_landmark("nipple")).norm(), radius, 1e-9);
      EXPECT_TRUE(matcher.tissue_in_to(uv));
      ++points;
    }
  }
  EXPECT_GT(points, 50);
}

TEST(Correspondence, AirAndTheBackAreNamed) {
  const HexMesh cc = squashed(body(), View::cc, 0.5), mlo = squashed(body(), View::mlo, 0.6);
  const Matcher matcher(cc, mlo);
  const MatchedCurve air = matcher.match({matcher.from_frame().width - 1, 1});
  EXPECT_TRUE(air.in_air());
  const Vec2 nipple = *matcher.from_landmark("nipple");
  const MatchedCurve behind = matcher.match({-3, nipple.y()});
  EXPECT_FALSE(behind.in_air());
  EXPECT_TRUE(behind.through_back);
}

TEST(Correspondence, TheCurvesLengthInsideTheImageIsMeasured) {
  const HexMesh cc = squashed(body(), View::cc, 0.5);
  HexMesh mlo = squashed(body(), View::mlo, 0.6);
  const Matcher whole(cc, mlo);
  const MatchedCurve all = whole.match(*whole.from_landmark("tumour"));
  EXPECT_NEAR(all.inside_image, all.length, 1e-9);
  // Sheared along the column: the curve, straight, crosses the posterior edge.
  for (Vec3& x : mlo.points) x.y() += 1.5 * x.z();
  add_contact(mlo, View::mlo);
  const Matcher matcher(cc, mlo);
  bool crossed = false;
  for (double u = 2; u < 40; u += 2) {
    const MatchedCurve curve = matcher.match({u, (*matcher.from_landmark("tumour")).y()});
    if (curve.in_air()) continue;
    const double a = curve.points.front().to_uv.x(), b = curve.points.back().to_uv.x();
    if ((a < 0) == (b < 0)) continue;
    crossed = true;
    const double front = std::max(a, b) / std::abs(a - b);  // straight: by its ends
    EXPECT_NEAR(curve.inside_image / curve.length, front, 1e-6);
    EXPECT_NEAR(curve.behind_image / curve.length, 1 - front, 0.05);  // to a step
  }
  EXPECT_TRUE(crossed);
}

TEST(Correspondence, RefusesMeshesOfDifferentBodies) {
  const HexMesh cc = squashed(body(), View::cc, 0.5), mlo = squashed(body(), View::mlo, 0.6);
  HexMesh other = mlo;
  other.imaged[17].x() += 0.1;
  EXPECT_THROW(Matcher(cc, other), Error);
  other = mlo;
  other.side = Side::right;
  EXPECT_THROW(Matcher(cc, other), Error);
  other = mlo;
  other.contact.reset();
  EXPECT_THROW(Matcher(cc, other), Error);
}
