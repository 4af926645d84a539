// Gravity at the edges of what may be asked: very soft and very stiff tissue, strong contrast, many
// times the weight, poor elements, states that have no unloaded shape, bad input.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/shapes.hpp"
#include "mechanics/mechanics.hpp"

namespace breast {
namespace {

const Vec3 prone(0, -gravity_mm_s2, 0);

MechanicsOptions scaled_options(double factor, double gland = 1) {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  for (Law& law : options.materials.laws) law = law.scaled(factor);
  Law& fibroglandular = options.materials.laws[std::size_t(Tissue::fibroglandular)];
  fibroglandular = fibroglandular.scaled(gland);
  return options;
}

// Backward and forward again; the largest distance from the imaged shape, mm.
double closure(HexMesh mesh, const Vec3& gravity, const MechanicsOptions& options, int most_steps) {
  SolveSummary summary = solve_backward(mesh, gravity, options);
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  EXPECT_TRUE(summary.stable);
  EXPECT_LE(summary.newton_iterations, most_steps);
  summary = solve_forward(mesh, gravity, options);
  EXPECT_TRUE(summary.converged()) << summary.record.reason;
  double worst = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    worst = std::max(worst, (mesh.points[i] - mesh.imaged[i]).norm());
  }
  return worst;
}

TEST(Stiffness, FromTwoPercentToAHundredfold) {
  const HexMesh mesh = fixtures::cap({.elements = 6});
  for (const double factor : {0.02, 0.1, 100.0}) {
    EXPECT_LT(closure(mesh, prone, scaled_options(factor), 9), 1e-8) << factor;
  }
}

TEST(Stiffness, ContrastOfTenThousand) {
  const HexMesh mesh = fixtures::cap({.elements = 6});
  EXPECT_LT(closure(mesh, prone, scaled_options(1, 1e4), 9), 1e-8);
  EXPECT_LT(closure(mesh, prone, scaled_options(1, 1e-2), 12), 1e-7);
}

TEST(Stiffness, StiffAndThickSkin) {
  for (const double thickness : {0.5, 3.0}) {
    MechanicsOptions options = scaled_options(1);
    scale_materials(options.materials, {"skin=1000"});
    EXPECT_LT(closure(fixtures::cap({.elements = 6, .skin_mm = thickness}), prone, options, 9),
              1e-8);
  }
}

TEST(Weight, UpToTwentyfold) {
  const HexMesh mesh = fixtures::cap({.elements = 6});
  EXPECT_LT(closure(mesh, 5 * prone, scaled_options(1), 9), 1e-8);
  EXPECT_LT(closure(mesh, 20 * prone, scaled_options(1), 10), 1e-8);
}

// A breast standing on its tip far beyond buckling: an answer, or the reason why there is none.
TEST(Weight, UnstableStatesAreSaidToBe) {
  HexMesh mesh = fixtures::cap({.elements = 6, .skin_mm = 0});
  MechanicsOptions options = scaled_options(1);
  for (Law& law : options.materials.laws) law = Law{LawKind::neo_hookean, {20}};
  const SolveSummary summary = solve_backward(mesh, -5 * prone, options);
  if (summary.converged()) {
    EXPECT_FALSE(summary.stable && summary.doubts.empty());
  } else {
    EXPECT_FALSE(summary.record.reason.empty());
    for (const Vec3& x : mesh.reference) EXPECT_TRUE(x.allFinite());
  }
}

TEST(Mesh, PoorElementsOnlyCostIterations) {
  fixtures::BlockSettings settings;
  settings.elements = {4, 4, 4};
  settings.distortion = 0.42;  // scaled Jacobians near zero
  const HexMesh mesh = fixtures::block(settings);
  EXPECT_LT(closure(mesh, Vec3(0, 0, -gravity_mm_s2), scaled_options(1), 12), 1e-8);
}

TEST(Mesh, FlatElementsOfAspectFifty) {
  fixtures::BlockSettings settings;
  settings.elements = {3, 3, 10};
  settings.size = Vec3(60, 60, 4);
  const HexMesh mesh = fixtures::block(settings);
  EXPECT_LT(closure(mesh, Vec3(0, 0, -0.0005 * gravity_mm_s2), scaled_options(1), 9), 1e-8);
}

TEST(Input, IsRefusedInWords) {
  const MechanicsOptions options = scaled_options(1);
  HexMesh folded = fixtures::cap({.elements = 4});
  std::swap(folded.imaged[folded.element(3)[0]], folded.imaged[folded.element(3)[6]]);
  EXPECT_THROW(solve_backward(folded, prone, options), Error);
  HexMesh unheld = fixtures::cap({.elements = 4});
  unheld.pectoral_faces.clear();
  EXPECT_THROW(solve_forward(unheld, prone, options), Error);
  HexMesh unloaded = fixtures::cap({.elements = 4});
  unloaded.reference.clear();
  EXPECT_THROW(solve_forward(unloaded, prone, options), Error);
  HexMesh bare = fixtures::cap({.elements = 4});
  bare.skin_thickness.pop_back();
  EXPECT_THROW(solve_forward(bare, prone, options), Error);
  MechanicsOptions multigrid = options;
  multigrid.solver = "multigrid";
  HexMesh mesh = fixtures::cap({.elements = 4});
  EXPECT_THROW(solve_forward(mesh, prone, multigrid), Error);
}

// Not-a-number anywhere ends as an error or as "not converged", never as a result.
TEST(Input, NaNNeverConverges) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HexMesh mesh = fixtures::cap({.elements = 4});
  mesh.reference[20].x() = nan;
  EXPECT_FALSE(solve_forward(mesh, prone, scaled_options(1)).converged());
  mesh = fixtures::cap({.elements = 4});
  mesh.imaged[20].x() = nan;
  EXPECT_THROW(solve_backward(mesh, prone, scaled_options(1)), Error);
  mesh = fixtures::cap({.elements = 4});
  EXPECT_FALSE(solve_forward(mesh, Vec3(0, nan, 0), scaled_options(1)).converged());
}

}  // namespace
}  // namespace breast
