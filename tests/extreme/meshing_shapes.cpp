// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes at the edge of what breasts are: very pendulous, thin, sagging, tiny; and hostile sizes.
#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "mesh/quality.hpp"
#include "meshing/attempts.hpp"

namespace breast {
namespace {

// Tests run beside one another: threads waiting for a busy core cost more than they bring.
class OneThread : public testing::Environment {
  void SetUp() override { set_threads(1); }
};
const auto* const one_thread = testing::AddGlobalTestEnvironment(new OneThread);

struct Case {
  const char* name;
  AnalyticBreast shape;
  double least;  ///< scaled Jacobian
};

class Shapes : public testing::TestWithParam<Case> {};

TEST_P(Shapes, DomeIsNotFolded) {
  BodyMeshReport report;
  const HexMesh mesh = body_mesh(analytic_breast(GetParam().shape), {}, &report);
  EXPECT_GT(report.smoothed_scaled_jacobian, GetParam().least);
  EXPECT_GT(mesh_quality(mesh, mesh.points).min_det, 0);
  EXPECT_NEAR(report.mesh_volume / report.body_volume, 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Breasts, Shapes,
    testing::Values(Case{"pendulous", {.arc = 150, .steepest_deg = 92}, 0.5},
                    Case{"overhanging", {.arc = 160, .steepest_deg = 100, .sag = 20}, 0.3},
                    Case{"flat", {.arc = 120, .steepest_deg = 35}, 0.5},
                    Case{"thin_rim", {.arc = 110, .steepest_deg = 65, .tissue_at_rim = 6}, 0.4},
                    Case{"thick_rim", {.arc = 120, .steepest_deg = 70, .tissue_at_rim = 50}, 0.5},
                    Case{"tiny", {.arc = 45, .steepest_deg = 70, .tissue_at_rim = 8}, 0.4},
                    Case{"curved_wall", {.arc = 122, .steepest_deg = 70, .wall_radius = 90}, 0.4}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(ExtremeMeshing, EitherGoodOrRefusedNeverFolded) {
  for (const double steepest : {105.0, 115.0, 125.0}) {
    const BreastGeometry geometry =
        analytic_breast({.arc = 170, .steepest_deg = steepest, .sag = 30});
    try {
      const HexMesh mesh = body_mesh(geometry, {.size = dome_near(8)});  // every step is tried
      EXPECT_GT(mesh_quality(mesh, mesh.points).min_det, 0) << steepest;
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      EXPECT_NE(std::string(error.what()).find("element"), std::string::npos) << error.what();
    }
  }
}

TEST(ExtremeMeshing, CoarsestAndSlimSizes) {
  for (const DomeSize& size : {DomeSize{2, 2, 1, 1}, {4, 12, 2, 3}, {12, 4, 2, 1}, {2, 3, 8, 1}}) {
    const HexMesh mesh = body_mesh(analytic_breast(), {.size = size});
    EXPECT_GT(mesh_quality(mesh, mesh.points).min_scaled_jacobian, 0.05);
  }
}

/// Slim cores and a cut of one row over a breast that overhangs: the mesh that is asked for is bad, and
/// what is taken instead says by which step it was found.
TEST(ExtremeMeshing, ABadMeshIsReplacedByTheStatedSteps) {
  const BreastGeometry geometry = analytic_breast({.arc = 160, .steepest_deg = 100, .sag = 20});
  BodyMeshReport report;
  const HexMesh mesh = body_mesh(geometry, {.size = {12, 3, 1, 1}}, &report);
  EXPECT_LT(report.asked_scaled_jacobian, wanted_scaled_jacobian);
  EXPECT_GE(report.smoothed_scaled_jacobian, wanted_scaled_jacobian);
  EXPECT_GT(report.attempts, 1);
  EXPECT_FALSE(report.step.empty());
  EXPECT_GE(mesh_quality(mesh, mesh.points).min_scaled_jacobian, wanted_scaled_jacobian);
}

TEST(ExtremeMeshing, TooThickSkinIsRefused) {
  EXPECT_THROW(body_mesh(analytic_breast({.arc = 45, .tissue_at_rim = 5}), {.skin_layer = 9}),
               Error);
}

}  // namespace
}  // namespace breast
