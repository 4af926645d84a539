// Contact against closed forms and symmetry, on real elements.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/active_set.hpp"
#include "contact/path.hpp"
#include "contact/saddle_body.hpp"
#include "core/units.hpp"
#include "fixtures/standing_block.hpp"
#include "mechanics/scene.hpp"

using namespace breast;

namespace {

/// Plates wider than the block, edges far away, about its mid-height.
PlatePair wide_plates(double height) {
  PlatePair pair;
  Plate plate;
  const ViewPose pose = view_pose(Side::left, 0);
  plate.n = pose.n;
  plate.anterior = pose.e_u;
  plate.lateral = pose.e_v;
  plate.edge_start = -500;
  plate.far_edge = 500;
  plate.half_width = 500;
  plate.edge_radius = 10;
  pair.paddle = pair.detector = plate;
  pair.paddle.name = "paddle";
  pair.detector.name = "detector";
  pair.detector.sign = -1;
  pair.initial_thickness = pair.touching_thickness = height;
  pair.paddle_start = -height;  // beam n = −z: h runs downwards from the top at z = height
  pair.detector_start = 0;
  pair.close_to(height);
  return pair;
}

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
    PlatePair plates = wide_plates(size.z());
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
