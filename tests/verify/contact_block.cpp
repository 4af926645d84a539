// SPDX-License-Identifier: GPL-3.0-or-later
// Contact against closed forms and symmetry, on real elements.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "fixtures/pressed_block.hpp"
#include "fixtures/rivlin_pressure.hpp"
#include "fixtures/standing_block.hpp"
#include "mesh/nodal_faces.hpp"

using namespace breast;

namespace {

using fixtures::PressedBody;

MechanicsOptions seed2008() {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  return options;
}

/// Nodes on z = 0 and z = top.
std::vector<int> top_and_bottom(const HexMesh& mesh, double top) {
  std::vector<int> nodes;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const double z = mesh.reference[std::size_t(node)].z();
    if (z < 1e-9 || z > top - 1e-9) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace

TEST(ContactBlock, RivlinCompressionBetweenFrictionlessPlates) {
  const Vec3 size(30, 20, 40);
  const double ratio = 0.6;
  for (const Tissue tissue : {Tissue::fat, Tissue::skin}) {
    HexMesh mesh = fixtures::standing_block(size, {3, 2, 4});
    mesh.tissue.assign(mesh.tissue.size(), tissue);
    PressedBody body(mesh, seed2008(), fixtures::mirror_planes(mesh),
                     top_and_bottom(mesh, size.z()), fixtures::wide_plates(0, size.z()));
    const PathResult path = body.close_to(ratio * size.z());
    ASSERT_TRUE(path.reached()) << describe(path.last_failure) << " at " << path.failed_thickness;
    // Homogeneous: x' = x/√λ, y' = y/√λ, z' = λ (z − h/2) + h/2.
    double worst = 0;
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Vec3& x = mesh.reference[std::size_t(node)];
      const Vec3 exact(x.x() / std::sqrt(ratio), x.y() / std::sqrt(ratio),
                       ratio * (x.z() - size.z() / 2) + size.z() / 2);
      worst = std::max(worst, (Vec3(body.state.x.segment<3>(3 * node)) - exact).norm());
    }
    EXPECT_LT(worst, 1e-7);
    const double exact = fixtures::rivlin_pressure(seed2008().materials.law(tissue), ratio) *
                         size.x() * size.y() / micronewton_per_newton;
    EXPECT_NEAR(path.points.back().paddle_N / exact, 1, 1e-8);
    EXPECT_NEAR(path.points.back().detector_N / exact, 1, 1e-8);
    EXPECT_LT(path.final_step.forces.max_volume_error, 1e-9);
  }
}

// The patch test: whatever the mesh inside and under the plates, one pressure reaches every node.
TEST(ContactBlock, UniformPressurePassesThroughADistortedMesh) {
  constexpr double side = 30, ratio = 0.7;
  for (const int order : {1, 2}) {
    SCOPED_TRACE(order);
    // The same distortion would turn corners of 27-node elements inside out before any load.
    HexMesh mesh = fixtures::block({.elements = {3, 3, 3},
                                    .size = Vec3(side, side, side),
                                    .order = order,
                                    .distortion = order == 1 ? 0.2 : 0.1});
    for (int node = 0; order == 1 && node < mesh.nodes(); ++node) {
      Vec3& x = mesh.reference[std::size_t(node)];
      const auto inner = [&](double at) { return at > 1e-9 && at < side - 1e-9; };
      if (inner(x.z()) || !inner(x.x()) || !inner(x.y())) continue;  // faces of the plates
      x += Vec3(2 * fixtures::noise(node), 2 * fixtures::noise(node + 7), 0);
    }
    mesh.imaged = mesh.points = mesh.reference;
    MechanicsOptions options = seed2008();
    options.element = order == 1 ? Element::q1p0 : Element::q2p1;
    PressedBody body(mesh, options, fixtures::mirror_planes(mesh), top_and_bottom(mesh, side),
                     fixtures::wide_plates(0, side));
    const PathResult path = body.close_to(ratio * side);
    ASSERT_TRUE(path.reached()) << describe(path.last_failure);
    // Force per present area.
    const double exact =
        fixtures::rivlin_pressure(options.materials.law(Tissue::fat), ratio) * ratio;
    std::vector<Face> plates;
    for (const Face& face : mesh.skin_faces) {
      double low = side, high = 0;
      for (const int node : face_nodes(mesh, face)) {
        low = std::min(low, mesh.reference[std::size_t(node)].z());
        high = std::max(high, mesh.reference[std::size_t(node)].z());
      }
      if (high < 1e-9 || low > side - 1e-9) plates.push_back(face);
    }
    const NodalFaces area = nodal_faces(mesh, plates, body.state.x);
    const std::vector<NodalContact>& contacts = path.final_step.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const double pressure = contacts[c].normal / area.area[std::size_t(body.candidates()[c])];
      EXPECT_NEAR(pressure / exact, 1, 1e-7) << "node " << body.candidates()[c];
    }
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
           {0.7, 361.1}, {0.6, 1258.1}, {0.5, 4134.7}, {0.4, 14499}}) {
    const PathResult path = nearly.close_to(gap);
    ASSERT_TRUE(path.reached()) << gap << ": " << describe(path.last_failure);
    EXPECT_NEAR(nearly.force(path) / force, 1, 0.005) << gap;
    if (std::abs(gap - 0.6) < 0.01) {
      const Vec3 from_the_plane(28.224, 15.252, -20);
      EXPECT_LT((nearly.corner() - from_the_plane).norm(), 2e-3);
    }
    if (gap < 0.45) continue;
    const PathResult exact = exactly.close_to(gap);
    ASSERT_TRUE(exact.reached()) << gap;
    EXPECT_NEAR(exactly.force(exact) / force, 1, 0.025) << gap;
    EXPECT_LT(exact.final_step.forces.max_volume_error, 1e-9);
  }
  // The program's 60532 N at 0.3 belong to a shape with elements inside out at corners of the clamp.
  EXPECT_EQ(nearly.close_to(0.3).last_failure, NewtonStop::folded);
}

TEST(ContactBlock, TheWholeCubeStaysSymmetricAsLongAsThatIsStable) {
  using fixtures::PressedBlock;
  PressedBlock whole(8, 1e4);
  const PathResult path = whole.close_to(0.6);
  ASSERT_TRUE(path.reached());
  EXPECT_NEAR(whole.force(path) / 1258.1, 1, 1e-3);
  EXPECT_NEAR(path.points.back().detector_N / path.points.back().paddle_N, 1, 1e-6);
  EXPECT_EQ(path.indefinite, 0);
}
