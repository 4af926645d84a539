// Compression far from the ordinary: every run ends converged or with a true, typed reason.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/compression.hpp"
#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/standing_block.hpp"

using namespace breast;

namespace {

const HexMesh& breast_mesh() {
  static const HexMesh mesh = [] {
    HexMesh made = analytic_breast_mesh(6);
    made.reference = made.points;
    return made;
  }();
  return mesh;
}

MechanicsOptions with_scale(const std::vector<std::string>& scale) {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  scale_materials(options.materials, scale);
  return options;
}

CompressionOptions to_reduction(double percent) {
  CompressionOptions options;
  options.target = percent;
  return options;
}

/// Converged at the target, or stopped in an equilibrium with a reason; never a folded mesh.
CompressionSummary check_ending(const CompressionOptions& options,
                                const MechanicsOptions& mechanics) {
  HexMesh mesh = breast_mesh();
  CompressionSummary summary = compress(mesh, options, mechanics);
  const std::string& status = summary.record.status;
  EXPECT_TRUE(status == "converged" || status == "stopped_early") << status;
  EXPECT_EQ(status == "converged", summary.record.reason.empty());
  EXPECT_GT(summary.min_det_F, 0);
  EXPECT_LT(summary.force_balance, 1e-7);
  for (const PlateRecord& plate : mesh.contact->plates) EXPECT_LT(plate.worst_gap_mm, 1e-6);
  if (status == "converged") {
    EXPECT_NEAR(summary.reduction_percent, options.target, 1e-6);
  }
  return summary;
}

}  // namespace

TEST(ContactExtreme, SharpAndRoundPlateEdges) {
  for (const double radius : {0.0, 3.0, 10.0}) {
    SCOPED_TRACE(radius);
    CompressionOptions options = to_reduction(40);
    options.plates.edge_radius = radius;
    EXPECT_GT(check_ending(options, with_scale({})).reduction_percent, 20);
  }
}

TEST(ContactExtreme, SeventyPercent) {
  const CompressionSummary summary = check_ending(to_reduction(70), with_scale({}));
  EXPECT_GE(summary.reduction_percent, 45) << summary.record.reason;
}

TEST(ContactExtreme, StiffGlandAndSoftBreast) {
  // On this coarse mesh the fat over the stiff gland slips off the plate edge, near 28 %.
  EXPECT_GE(check_ending(to_reduction(45), with_scale({"fibroglandular=1000"})).reduction_percent,
            25);
  EXPECT_GE(check_ending(to_reduction(45), with_scale({"fat=10", "fibroglandular=10", "skin=10"}))
                .reduction_percent,
            40);
}

TEST(ContactExtreme, TiltedPaddleAndShallowAngles) {
  CompressionOptions options = to_reduction(40);
  options.plates.tilt_deg = 6;
  EXPECT_GE(check_ending(options, with_scale({})).reduction_percent, 35);
  options.plates.tilt_deg = 0;
  options.view = "ML";
  options.angle_deg = 90;
  EXPECT_GE(check_ending(options, with_scale({})).reduction_percent, 35);
}

TEST(ContactExtreme, PlatesThatMissTheBreastAreRefused) {
  HexMesh mesh = breast_mesh();
  CompressionOptions options = to_reduction(50);
  options.plates.standoff = 300;
  EXPECT_THROW(compress(mesh, options, with_scale({})), Error);
}

TEST(ContactExtreme, PlatesThatTouchOnlyTheNipple) {
  CompressionOptions options = to_reduction(30);
  double front = -1e9, wall = -1e9;
  for (const int node : nodes_of(breast_mesh(), breast_mesh().skin_faces)) {
    front = std::max(front, -breast_mesh().points[std::size_t(node)].y());
  }
  for (const auto* faces : {&breast_mesh().pectoral_faces, &breast_mesh().cut_faces}) {
    for (const int node : nodes_of(breast_mesh(), *faces)) {
      wall = std::max(wall, -breast_mesh().points[std::size_t(node)].y());
    }
  }
  options.plates.standoff = front - wall - 12;
  options.gravity = Vec3::Zero();
  EXPECT_GT(check_ending(options, with_scale({})).initial_thickness_mm, 1);
}

TEST(ContactExtreme, PlatesThatStartInsideTheBreast) {
  CompressionOptions options = to_reduction(40);
  options.path.first_step = options.path.longest_step = 1000;  // the whole way in one step
  EXPECT_GE(check_ending(options, with_scale({})).reduction_percent, 35);
}
