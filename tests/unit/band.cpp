// SPDX-License-Identifier: GPL-3.0-or-later
// The band's linear propagation against re-matched perturbed shapes:
// derivative, sampling, coverage.
#include "matching/band_materials.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/squashed.hpp"
#include "matching/band_edges.hpp"
#include "mesh/locate.hpp"
#include "meshing/body_mesh.hpp"

using namespace breast;
using namespace breast::fixtures;

namespace {

HexMesh breast_with_nipple() {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  mesh.reference = mesh.imaged;
  const Location found = Locator(mesh, mesh.imaged).nearest(Vec3(0, 0, 0));
  mesh.landmarks.push_back({"nipple", Vec3(0, 0, 0), found.element, found.local, found.moved});
  return mesh;
}

const HexMesh& body() {
  static const HexMesh mesh = breast_with_nipple();
  return mesh;
}

// A compression with three parameters, zero at the expected state: a stiffness that bends both
// shapes, and the thickness of each.
HexMesh shape(View view, double stiffness, double thickness, double lean_deg = 0) {
  const double lambda = 0.6 + thickness / 90;
  HexMesh mesh = squashed(body(), view, lambda);
  mesh.contact->lean_deg = lean_deg;
  for (Vec3& x : mesh.points) {
    const double s = 1 + stiffness;
    x += Vec3(3 * std::sin(x.z() / 15), 4 * s * std::sin((x.z() + x.x()) / 20), s * x.y() / 25);
  }
  // The detector does not follow the shape: images are compared in the patient frame.
  return mesh;
}

NodalField difference(View view, double stiffness, double thickness) {
  const HexMesh plus = shape(view, stiffness, thickness),
                minus = shape(view, -stiffness, -thickness);
  NodalField field(plus.points.size());
  for (std::size_t i = 0; i < field.size(); ++i) {
    field[i] = (plus.points[i] - minus.points[i]) / (2 * (stiffness + thickness));
  }
  return field;
}

struct Scene {
  explicit Scene(double lean_deg = 0) : mlo(shape(View::mlo, 0, 0, lean_deg)) {}
  HexMesh cc = shape(View::cc, 0, 0), mlo;
  Matcher matcher{cc, mlo};
  DerivativeFields from{{"fat", difference(View::cc, 1e-4, 0)},
                        {"thickness", difference(View::cc, 0, 1e-4)}},
      to{{"fat", difference(View::mlo, 1e-4, 0)}, {"thickness", difference(View::mlo, 0, 1e-4)}};
};

// Where the curve of the same detector position lies for other parameters, in the base image frame.
MatchedCurve rematched(const Scene& scene, const HexMesh& cc, const HexMesh& mlo, const Vec2& uv) {
  const Matcher other(cc, mlo);
  const auto offset = [](const Matcher& a, const Matcher& b, bool to) -> Vec2 {
    const ViewPose& from = to ? a.to_frame().pose : a.from_frame().pose;
    return from.project(to ? b.to_frame().pose.origin : b.from_frame().pose.origin);
  };
  MatchedCurve curve = other.match(uv - offset(scene.matcher, other, false), 0.001);
  for (ColumnPoint& point : curve.points) point.to_uv += offset(scene.matcher, other, true);
  return curve;
}

// Signed distance of a curve from a point along a direction, where it crosses.
double crossing(const MatchedCurve& curve, const BandPoint& point) {
  const Vec2 along(point.normal.y(), -point.normal.x());
  double found = 1e9;
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    const Vec2 a = curve.points[i - 1].to_uv - point.uv, b = curve.points[i].to_uv - point.uv;
    const double ta = a.dot(along), tb = b.dot(along);
    if (ta == tb || ta * tb > 0) continue;
    const double f = ta / (ta - tb), across = (a + f * (b - a)).dot(point.normal);
    if (std::abs(across) < std::abs(found)) found = across;
  }
  return found;
}

}  // namespace

TEST(Band, LinearPropagationIsTheDerivativeOfTheCurve) {
  const Scene scene;
  const Vec2 uv = *scene.matcher.from_landmark("nipple") + Vec2(-30, 8);
  const MatchedCurve curve = scene.matcher.match(uv, 0.001);
  ASSERT_FALSE(curve.in_air());
  constexpr double step = 1e-3;
  struct Case {
    const char *parameter, *cause;
    HexMesh cc, mlo;
  };
  const Case cases[] = {{"fat", "fat", shape(View::cc, step, 0), shape(View::mlo, step, 0)},
                        {"thickness", "thickness in CC", shape(View::cc, 0, step), scene.mlo},
                        {"thickness", "thickness in MLO", scene.cc, shape(View::mlo, 0, step)}};
  for (const Case& c : cases) {
    DerivativeFields from = scene.from, to = scene.to;
    NodalField zero(scene.cc.points.size(), Vec3::Zero());
    if (c.cause == std::string("thickness in CC")) to["thickness"] = zero;
    if (c.cause == std::string("thickness in MLO")) from["thickness"] = zero;
    const Band band = BandModel(scene.matcher, from, to, {{c.parameter, 1, "", ""}}).band(curve);
    const MatchedCurve moved = rematched(scene, c.cc, c.mlo, uv);
    int compared = 0;
    for (std::size_t i = 10; i + 10 < band.points.size(); i += 9) {
      const double real = std::abs(crossing(moved, band.points[i])) / step;
      EXPECT_NEAR(band.points[i].deviation, real, 0.02 * real + 0.02) << c.cause << " " << i;
      ++compared;
    }
    EXPECT_GT(compared, 5);
  }
}

// A shape that turns with its detector, about the same axis, has the same image: what is left is
// the motion along the beam where the curve bends.
class TurningBand : public testing::TestWithParam<double> {};

TEST_P(TurningBand, TheDetectorTurnsWithTheAngle) {
  const Scene scene(GetParam());
  const MatchedCurve curve =
      scene.matcher.match(*scene.matcher.from_landmark("nipple") + Vec2(-30, 8), 0.001);
  const auto turning = [](const HexMesh& mesh) {
    Vec3 low = mesh.points.front(), high = low;
    for (const Vec3& x : mesh.points) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    const Vec3 axis = lateral_sign(mesh.side) * std::numbers::pi / 180 * Vec3(0, -1, 0);
    NodalField field;
    for (const Vec3& x : mesh.points) field.push_back(axis.cross(x - 0.5 * (low + high)));
    return field;
  };
  const DerivativeFields from{{"angle", turning(scene.cc)}}, to{{"angle", turning(scene.mlo)}};
  const Band band = BandModel(scene.matcher, from, to, {{"angle", 1, "degree", ""}}).band(curve);
  for (const BandPoint& point : band.points) EXPECT_LT(point.deviation, 0.02);
  DerivativeFields still = from;
  for (Vec3& x : still.at("angle")) x.setZero();  // a shape that stays where it is does not
  const Band moved = BandModel(scene.matcher, still, to, {{"angle", 1, "degree", ""}}).band(curve);
  EXPECT_GT(moved.by_cause.at("angle in CC"), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Lean, TurningBand, testing::Values(0.0, 15.0));

TEST(Band, PickingIsTheDerivativeByTheMark) {
  const Scene scene;
  const Vec2 uv = *scene.matcher.from_landmark("nipple") + Vec2(-30, 8);
  const MatchedCurve curve = scene.matcher.match(uv, 0.001);
  const Band band = BandModel(scene.matcher, {}, {}, {{"picking", 1, "mm", ""}}).band(curve);
  constexpr double step = 1e-2;
  const MatchedCurve u = scene.matcher.match(uv + Vec2(step, 0), 0.001),
                     v = scene.matcher.match(uv + Vec2(0, step), 0.001);
  for (std::size_t i = 10; i + 10 < band.points.size(); i += 9) {
    const double real = std::hypot(crossing(u, band.points[i]), crossing(v, band.points[i])) / step;
    EXPECT_NEAR(band.points[i].deviation, real, 0.03 * real + 0.02);
  }
}

TEST(Band, CoversSampledCurvesAsOftenAsItSays) {
  const Scene scene;
  const std::vector<Prior> priors = {{"fat", 0.3, "", ""},
                                     {"thickness", 2, "", ""},
                                     {"picking", 0.7, "", ""},
                                     {"skin", 1, "", ""}};
  const BandModel model(scene.matcher, scene.from, scene.to, priors);
  const Vec2 mark = *scene.matcher.from_landmark("nipple") + Vec2(-28, -6);
  const MatchedCurve curve = scene.matcher.match(mark, 0.005);
  const Band band = model.band(curve);
  EXPECT_EQ(model.without(), std::vector<std::string>{"skin"});
  EXPECT_GT(band.area_95, 0);
  EXPECT_EQ(band.by_cause.size(), 4u);  // fat, thickness twice, picking
  std::mt19937 stream(1);
  std::normal_distribution<double> normal;
  int inside_95 = 0, inside_50 = 0, counted = 0;
  for (int sample = 0; sample < 250; ++sample) {
    const double fat = 0.3 * normal(stream);
    const HexMesh cc = shape(View::cc, fat, 2 * normal(stream)),
                  mlo = shape(View::mlo, fat, 2 * normal(stream));
    const Vec2 marked = mark + 0.7 * Vec2(normal(stream), normal(stream));
    const MatchedCurve sampled = rematched(scene, cc, mlo, marked);
    const BandPoint& point = band.points[band.points.size() / 2];
    const double z = std::abs(crossing(sampled, point)) / point.deviation;
    ++counted;
    inside_95 += z < half_width_95;
    inside_50 += z < half_width_50;
  }
  EXPECT_GE(inside_95, 0.91 * counted);
  EXPECT_LE(inside_95, 0.985 * counted);
  EXPECT_GE(inside_50, 0.40 * counted);
  EXPECT_LE(inside_50, 0.60 * counted);
}

// Two parameters that vary together: the band's variance is gᵀCg, and their own priors are gone.
TEST(Band, ACovarianceCountsWithItsCorrelations) {
  const Scene scene;
  const MatchedCurve curve =
      scene.matcher.match(*scene.matcher.from_landmark("nipple") + Vec2(-30, 8), 0.001);
  DerivativeFields from{{"stiffness", scene.from.at("fat")}, {"wall", scene.from.at("fat")}},
      to{{"stiffness", scene.to.at("fat")}, {"wall", scene.to.at("fat")}};
  for (Vec3& x : from.at("wall")) x *= -0.5;
  for (Vec3& x : to.at("wall")) x *= -0.5;
  const auto deviation = [&](const Eigen::Matrix2d& covariance) {
    DerivativeFields f = from, t = to;
    std::vector<Prior> priors{{"fat", 0.7, "", ""}, {"wall", 0.7, "", ""}};
    use_covariance({"stiffness", "wall"}, covariance, f, t, priors);
    EXPECT_EQ(priors.size(), 2u);
    return BandModel(scene.matcher, f, t, priors).band(curve).points[10].deviation;
  };
  const double one = BandModel(scene.matcher, scene.from, scene.to, {{"fat", 1, "", ""}})
                         .band(curve)
                         .points[10]
                         .deviation;
  Eigen::Matrix2d c;
  c << 0.04, 0.03, 0.03, 0.09;  // g = (1, -0.5): 0.04 - 0.03 + 0.0225
  EXPECT_NEAR(deviation(c), one * std::sqrt(0.0325), 1e-9);
  c(0, 1) = c(1, 0) = -0.03;
  EXPECT_NEAR(deviation(c), one * std::sqrt(0.0925), 1e-9);
  DerivativeFields none;
  std::vector<Prior> priors;
  EXPECT_THROW(use_covariance({"wall"}, Eigen::MatrixXd::Identity(1, 1), none, to, priors), Error);
}

// Lines that turn by 30 to 150 degrees at a corner, and back after 12 mm, with a band that gets wider.
TEST(Band, EveryPlaceOfItsEdgesIsHalfItsWidthFromTheCurve) {
  for (const double degrees : {30.0, 90.0, 120.0, 150.0}) {
    MatchedCurve curve;
    Band band;
    Vec2 at(0, 0);
    double angle = 0;
    for (int i = 0; i < 120; ++i) {
      if (i == 60) angle += degrees * std::numbers::pi / 180;
      if (i == 72) angle -= degrees * std::numbers::pi / 180;
      ColumnPoint point;
      point.to_uv = at;
      curve.points.push_back(point);
      band.points.push_back({at, Vec2(0, 1), 2 + 0.02 * i});
      at += Vec2(std::cos(angle), std::sin(angle));
    }
    const std::vector<BandLine> lines = stretches_of(curve, band);
    ASSERT_EQ(lines.size(), 1u);
    int places = 0;
    for (const std::vector<Vec2>& edge : band_edges(lines[0], half_width_95)) {
      for (const Vec2& place : edge) {
        double nearest = 1e9;  // of the half width
        for (std::size_t i = 1; i < lines[0].size(); ++i) {
          const BandPoint &a = lines[0][i - 1], &b = lines[0][i];
          const Vec2 along = b.uv - a.uv;
          const double f = std::clamp((place - a.uv).dot(along) / along.squaredNorm(), 0.0, 1.0);
          const double half = half_width_95 * ((1 - f) * a.deviation + f * b.deviation);
          nearest = std::min(nearest, (place - a.uv - f * along).norm() / half);
        }
        EXPECT_GT(nearest, 0.96) << degrees << " degrees, " << place.transpose();
        EXPECT_LT(nearest, 1.03) << degrees << " degrees, " << place.transpose();
        ++places;
      }
    }
    EXPECT_GT(places, 100);
  }
}

TEST(Band, PriorsAreChecked) {
  const Table table = parse_table("parameter\tstandard_deviation\tsource\nfat\t0.5\tmine\n", "p");
  const std::vector<Prior> priors = priors_from(table, "p");
  ASSERT_EQ(priors.size(), 1u);
  EXPECT_EQ(priors[0].source, "mine");
  EXPECT_THROW(
      priors_from(parse_table("parameter\tstandard_deviation\nfat\t1\nfat\t1\n", "p"), "p"), Error);
  EXPECT_THROW(priors_from(parse_table("parameter\tstandard_deviation\n", "p"), "p"), Error);
  EXPECT_THROW(priors_from(parse_table("parameter\tstandard_deviation\nfat\t-1\n", "p"), "p"),
               Error);
  const Scene scene;
  DerivativeFields wrong{{"fat", NodalField(3)}};
  EXPECT_THROW(BandModel(scene.matcher, wrong, wrong, default_priors()), Error);
}
