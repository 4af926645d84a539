// SPDX-License-Identifier: GPL-3.0-or-later
// A patient's stiffness from two postures: derivatives, known answers, landmarks left out, limits.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/seen_skin.hpp"
#include "fixtures/sliding_cap.hpp"
#include "identification/identify.hpp"
#include "identification/knowledge.hpp"

using namespace breast;

namespace {

// A cap that slides on a sphere, in skin that wrinkles, four elements across.
struct Case {
  HexMesh mesh = fixtures::cap_on_sphere(4);
  IdentifyOptions options;

  Case() {
    options.mechanics.materials = load_materials("seed2008");
    options.mechanics.materials.skin = {0.05, 0.02, 0.03};
    fixtures::let_slide(options.mechanics, fixtures::sphere(), 0.02);
    options.mechanics.cut = cut_support("spring:0.01");
  }

  // Points through the body, each seen where `truth` (logarithms by name) puts it.
  Observations seen_with(const std::map<std::string, double>& truth, int points,
                         double rms_mm) const {
    const HexMesh second = second_with(truth);
    Observations seen;
    for (int k = 0; k < points; ++k) {
      const int element = (k * 7 + 3) % mesh.elements();
      const Vec3 local(0.3, -0.2, 0.1);
      seen.points.push_back({"point" + std::to_string(k),
                             {element, local, 0},
                             element_position(second, second.points, element, local),
                             coordinate_deviation(rms_mm)});
    }
    return seen;
  }
  HexMesh second_with(const std::map<std::string, double>& truth) const {
    Sought sought;
    Eigen::VectorXd x(truth.size());
    for (const auto& [name, value] : truth) {
      x[sought.materials()] = value;
      sought.names.push_back(name);
    }
    const MechanicsOptions mechanics = with_factors(options.mechanics, sought, x);
    HexMesh second = mesh;
    EXPECT_TRUE(fixtures::backward_into(second, options.imaged_gravity, mechanics).converged());
    EXPECT_TRUE(fixtures::forward_into(second, options.gravity, mechanics).converged());
    return second;
  }
};

TEST(Identification, ItsJacobianIsThatOfDifferences) {
  const Case c;
  Observations seen = c.seen_with({{"low_order", 0.2}, {"wall", -0.3}}, 6, 2.5);
  seen.surface = fixtures::seen_skin(c.second_with({{"low_order", 0.2}}), 12);
  Sought sought{{"low_order", "quadratic", "gland", "skin", "wall", "cut"}, true};
  SecondPosture model(c.mesh, c.options.mechanics, c.options.imaged_gravity, c.options.gravity,
                      seen, sought);
  Eigen::VectorXd x(sought.count());
  x << 0.1, -0.1, 0.2, 0.1, 0.1, -0.2, 0.5, -0.4, 0.3, 1.2, -0.7, 0.9;
  ASSERT_TRUE(model.residuals(x)) << model.reason();
  EXPECT_GT(model.surface_points(), 3u);
  const Eigen::MatrixXd j = model.jacobian();
  constexpr double h = 1e-3;
  const Eigen::Index points = 3 * Eigen::Index(seen.points.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd more = x, less = x;
    more[k] += h, less[k] -= h;
    const Eigen::VectorXd slope = (*model.residuals(more) - *model.residuals(less)) / (2 * h);
    ASSERT_GT(slope.norm(), 1e-4) << k;
    EXPECT_LT((slope - j.col(k)).head(points).norm(), 2e-5 * slope.norm()) << k;
    // The nearest point seen may change: most of the sampled places keep theirs.
    int same = 0;
    for (Eigen::Index i = points; i < slope.size(); ++i)
      same += std::abs(slope[i] - j(i, k)) < 1e-4 * slope.norm();
    EXPECT_GE(same, int(slope.size() - points) - 1) << k;
  }
}

TEST(Identification, FindsWhatMadeExactDataFromFarAway) {
  Case c;
  c.options.parameters = {"stiffness", "gland", "wall", "cut"};
  c.options.prior = PriorKind::none;
  const Observations seen =
      c.seen_with({{"stiffness", -0.8}, {"gland", 0.5}, {"wall", 0.7}, {"cut", -0.6}}, 12, 0.01);
  const Identified found = identify(c.mesh, seen, c.options);
  EXPECT_TRUE(found.fit.converged);
  EXPECT_LE(found.pairs, 25);
  EXPECT_NEAR(found.fit.x[0], -0.8, 0.01);
  EXPECT_NEAR(found.fit.x[1], 0.5, 0.02);
  EXPECT_NEAR(found.fit.x[2], 0.7, 0.02);
  EXPECT_NEAR(found.fit.x[3], -0.6, 0.02);
  for (const LandmarkFit& landmark : found.landmarks) EXPECT_LT(landmark.residual, 0.01);
}

TEST(Identification, TheRibCagesMotionIsToldFromTheBreasts) {
  Case c;
  c.options.parameters = {"stiffness", "wall"};
  c.options.align = true;
  Observations seen = c.seen_with({{"stiffness", -0.3}, {"wall", 0.4}}, 20, 0.05);
  RigidMotion moved;
  moved.shift = Vec3(3, -2, 2), moved.turn = Vec3(1, 1.5, -1);
  for (SeenPoint& point : seen.points) point.seen = moved(point.seen);
  const Identified found = identify(c.mesh, seen, c.options);
  EXPECT_NEAR(found.fit.x[0], -0.3, 0.02);
  EXPECT_NEAR(found.fit.x[1], 0.4, 0.05);
  EXPECT_LT((found.motion.turn - moved.turn).norm(), 0.1);
  for (const LandmarkFit& landmark : found.landmarks) EXPECT_LT(landmark.residual, 0.05);
}

// The linearised answer for a landmark left out is what really leaving it out gives.
TEST(Identification, LeavingALandmarkOutIsPredictedByTheHatMatrix) {
  Case c;
  c.options.parameters = {"stiffness", "wall", "cut"};
  Observations seen = c.seen_with({{"stiffness", -0.2}, {"wall", 0.2}, {"cut", 0.1}}, 6, 0.5);
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    seen.points[i].seen += 0.5 * Vec3(std::sin(7.0 * i), std::cos(5.0 * i), std::sin(3.0 * i + 1));
  const Identified whole = identify(c.mesh, seen, c.options);
  const Observations all = seen;
  for (const std::size_t out : {std::size_t(1), std::size_t(4)}) {
    seen = all;
    seen.points.erase(seen.points.begin() + long(out));
    const Identified rest = identify(c.mesh, seen, c.options);
    const SeenPoint& point = all.points[out];
    const Vec3 predicted =
        element_position(rest.second, rest.second.points, point.at.element, point.at.local);
    const double truly = (predicted - point.seen).norm();
    EXPECT_NEAR(whole.landmarks[out].left_out, truly, 0.03 * truly);
    EXPECT_GT(whole.landmarks[out].left_out, whole.landmarks[out].residual);
  }
}

TEST(Identification, OfTheNippleAloneMostIsThePrior) {
  Case c;
  Observations seen = c.seen_with({{"low_order", -0.3}, {"wall", 0.3}}, 1, 2.5);
  const Landmark* nipple = c.mesh.landmark("nipple");
  ASSERT_NE(nipple, nullptr);
  const Identified found = identify(c.mesh, seen, c.options);
  EXPECT_LT(found.decided, 3.0);
  int open = 0;
  for (const KnownDirection& direction : found.directions)
    open += direction.words.find("not determined by these data") != std::string::npos;
  EXPECT_GE(open, 3);
}

TEST(Identification, ATrialWithoutAStableBodyIsALimit) {
  Case c;
  c.options.parameters = {"stiffness"};
  c.options.prior = PriorKind::none;
  Observations seen = c.seen_with({{"stiffness", -0.2}}, 2, 0.5);
  for (SeenPoint& point : seen.points) point.seen.y() += 400;  // no breast is as soft as this
  const Identified found = identify(c.mesh, seen, c.options);
  EXPECT_FALSE(found.refusals.empty());
  EXPECT_LT(found.misfit.probability, 1e-6);
  EXPECT_TRUE(std::isfinite(found.fit.x[0]));
}

TEST(Identification, TooFewDataWithoutAPriorAreRefused) {
  Case c;
  c.options.prior = PriorKind::none;
  const Observations seen = c.seen_with({{"low_order", -0.3}}, 1, 2.5);
  EXPECT_THROW(identify(c.mesh, seen, c.options), Error);
  EXPECT_THROW(identify(c.mesh, Observations(), c.options), Error);
}

TEST(ChiSquared, IsThatOfTables) {
  EXPECT_NEAR(chi_squared_above(3.841458820694124, 1), 0.05, 1e-12);
  EXPECT_NEAR(chi_squared_above(124.3421134, 100), 0.05, 1e-8);
  EXPECT_NEAR(chi_squared_above(2 * std::log(2.0), 2), 0.5, 1e-14);
  EXPECT_NEAR(chi_squared_above(20, 90), 1, 1e-12);
  EXPECT_EQ(chi_squared_above(0, 5), 1);
}

TEST(SetParameter, ScalesWhatItNames) {
  MechanicsOptions options;
  MaterialSet& set = options.materials;
  set = load_materials("invivo");
  take_supports_of_set(options);
  const MaterialSet was = set;
  EXPECT_EQ(model_parameters(options),
            (std::vector<std::string>{"low_order", "quadratic", "gland", "skin", "wall", "cut"}));
  scale_model(options, "gland", 3);
  EXPECT_NEAR(set.law(Tissue::fibroglandular).shear_modulus(),
              3 * was.law(Tissue::fibroglandular).shear_modulus(), 1e-9);
  EXPECT_EQ(set.law(Tissue::fat).constants, was.law(Tissue::fat).constants);
  scale_model(options, "quadratic", 0.5);
  EXPECT_NEAR(set.law(Tissue::fat).constants[2], 0.5 * was.law(Tissue::fat).constants[2], 1e-9);
  EXPECT_EQ(set.law(Tissue::fat).constants[0], was.law(Tissue::fat).constants[0]);
  scale_model(options, "cut", 2);
  EXPECT_EQ(options.cut->text(), "spring:0.038");
  EXPECT_EQ(set_with_supports(options).cut, "spring:0.038");
  EXPECT_NEAR(set.law(Tissue::skin).constants[1], 4.4, 1e-12);
  MechanicsOptions held;
  held.materials = load_materials("seed2008");
  EXPECT_THROW(scale_model(held, "wall", 2), Error);
}

}  // namespace
