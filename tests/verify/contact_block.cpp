// Contact against closed forms and symmetry, on real elements.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/active_set.hpp"
#include "contact/path.hpp"
#include "contact/saddle_body.hpp"
#include "core/units.hpp"
#include "fixtures/pressed_block.hpp"
#include "fixtures/standing_block.hpp"
#include "mechanics/scene.hpp"

using namespace breast;

namespace {

/// A block on two symmetry planes, x = 0 and y = 0, free elsewhere.
Constraints symmetry_planes(const HexMesh& mesh) {
  Constraints held(mesh.nodes());
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3& x = mesh.points[std::size_t(node)];
    NodeConstraint c;
    c.held = {std::abs(x.x()) < 1e-9, std::abs(x.y()) < 1e-9, false};
    if (c.held[0] || c.held[1]) held.set(node, c);
  }
  return held;
}

}  // namespace

TEST(ContactBlock, RivlinCompressionBetweenFrictionlessPlates) {
  const Vec3 size(30, 20, 40);
  const double ratio = 0.6;
  for (const Tissue tissue : {Tissue::fat, Tissue::skin}) {
    HexMesh mesh = fixtures::standing_block(size, {3, 2, 4});
    mesh.tissue.assign(mesh.tissue.size(), tissue);
    MechanicsOptions options;
    options.materials = load_materials("seed2008");
    const Scene scene(mesh, options);
    const ForwardProblem problem(scene, flatten(mesh.reference),
                                 Eigen::VectorXd::Zero(3L * mesh.nodes()));
    SaddleSolver solver(problem.pattern());
    const Constraints held = symmetry_planes(mesh);
    SaddleBody body(problem, solver, held, Vec3::Zero());
    std::vector<int> top_and_bottom;
    for (int node = 0; node < mesh.nodes(); ++node) {
      const double z = mesh.points[std::size_t(node)].z();
      if (z < 1e-9 || z > size.z() - 1e-9) top_and_bottom.push_back(node);
    }
    ActiveSet contact(body, top_and_bottom);
    PlatePair plates = fixtures::wide_plates(0, size.z());
    BodyState state{flatten(mesh.reference), scene.assembly().rest_pressure()};
    const auto area = [&](const BodyState&) {
      return std::vector<double>(top_and_bottom.size(), 1.0);
    };
    const PathResult path =
        follow_path(contact, plates, state, {TargetKind::thickness, ratio * size.z()}, area, {});
    ASSERT_TRUE(path.reached) << describe(path.last_failure) << " at " << path.failed_thickness;
    // Homogeneous: x' = x/√λ, y' = y/√λ, z' = λ (z − h/2) + h/2.
    double worst = 0;
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Vec3& x = mesh.reference[std::size_t(node)];
      const Vec3 exact(x.x() / std::sqrt(ratio), x.y() / std::sqrt(ratio),
                       ratio * (x.z() - size.z() / 2) + size.z() / 2);
      worst = std::max(worst, (Vec3(state.x.segment<3>(3 * node)) - exact).norm());
    }
    EXPECT_LT(worst, 1e-7);
    const double i1 = ratio * ratio + 2 / ratio, i2 = 2 * ratio + 1 / (ratio * ratio);
    const LawValue w = options.materials.law(tissue).evaluate(i1, i2);
    const double nominal = 2 * (ratio - 1 / (ratio * ratio)) * (w.w1 + w.w2 / ratio);
    const double exact = -nominal * size.x() * size.y() / micronewton_per_newton;
    EXPECT_NEAR(path.points.back().paddle_N / exact, 1, 1e-8);
    EXPECT_NEAR(path.points.back().detector_N / exact, 1, 1e-8);
    EXPECT_LT(path.final_step.forces.max_volume_error, 1e-9);
  }
}

// The cube other programs were run on, on their nodes and with their bulk modulus; force (N) at
// gaps of the height by a program that prescribes u_z on the touching nodes (all of them push). It
// stays symmetric, so does a quarter.
TEST(ContactBlock, ForcesOfTheClampedCubeAgreeWithAnotherProgram) {
  using fixtures::PressedBlock;
  PressedBlock nearly(8, 1e4, PressedBlock::Part::quarter);
  PressedBlock exactly(8, 0, PressedBlock::Part::quarter);
  for (const auto& [gap, force] : std::vector<std::pair<double, double>>{
           {0.7, 361.1}, {0.6, 1258.1}, {0.5, 4134.7}, {0.4, 14499}, {0.3, 60532}}) {
    const PathResult path = nearly.close_to(gap);
    ASSERT_TRUE(path.reached) << gap << ": " << describe(path.last_failure);
    EXPECT_NEAR(nearly.force(path) / force, 1, 0.005) << gap;
    if (std::abs(gap - 0.6) < 0.01) {
      const Vec3 from_the_plane(28.224, 15.252, -20);
      EXPECT_LT((nearly.corner() - from_the_plane).norm(), 2e-3);
    }
    if (gap < 0.45) continue;
    const PathResult exact = exactly.close_to(gap);
    ASSERT_TRUE(exact.reached) << gap;
    EXPECT_NEAR(exactly.force(exact) / force, 1, 0.025) << gap;
    EXPECT_LT(exact.final_step.forces.max_volume_error, 1e-9);
  }
}

TEST(ContactBlock, TheWholeCubeStaysSymmetricAsLongAsThatIsStable) {
  using fixtures::PressedBlock;
  PressedBlock whole(8, 1e4);
  const PathResult path = whole.close_to(0.6);
  ASSERT_TRUE(path.reached);
  EXPECT_NEAR(whole.force(path) / 1258.1, 1, 1e-3);
  EXPECT_NEAR(path.points.back().detector_N / path.points.back().paddle_N, 1, 1e-6);
  EXPECT_EQ(path.indefinite, 0);
}
