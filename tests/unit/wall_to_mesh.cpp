// SPDX-License-Identifier: GPL-3.0-or-later
// A chest wall corrected by clicked points moves everything made from it: labels, sheet, mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "fit/fit_breast.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "meshing/body_mesh.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

struct Chain {
  Segmentation segmentation;
  FitReport fit;
  HexMesh mesh;
};

Chain run(const Volume<float>& scan, const std::vector<Vec3>& clicked) {
  Chain chain;
  SegmentOptions options;
  options.wall_points = clicked;
  Timer timer;
  chain.segmentation = segment_breast(scan, options, no_progress(), timer);
  FitOptions fit;
  fit.surface_step_mm = 5;
  const BreastGeometry geometry = fit_breast(chain.segmentation.labels, fit, chain.fit, timer);
  chain.mesh = body_mesh(geometry, {.size = dome_near(8)});
  return chain;
}

/// Mean y of the mesh's wall nodes within 30 mm of the breast's axis.
double wall_depth(const HexMesh& mesh) {
  double sum = 0, count = 0;
  for (const int a : nodes_of(mesh, mesh.pectoral_faces)) {
    const Vec3& x = mesh.points[a];
    if (std::hypot(x[0] - testing::SyntheticScan::half_width, x[2]) > 30) continue;
    sum += x[1];
    count += 1;
  }
  return sum / count;
}

TEST(ClickedWall, MovesTheMeshsWall) {
  const testing::SyntheticScan truth = testing::SyntheticScan::coarse();
  const Volume<float> scan = truth.image();
  constexpr double back = 6;  // mm
  std::vector<Vec3> clicked;
  for (double x = 25; x <= 125; x += 20) {
    for (double z = -50; z <= 50; z += 20) clicked.emplace_back(x, truth.wall(x, z) + back, z);
  }
  const Chain before = run(scan, {}), after = run(scan, clicked);
  EXPECT_NEAR(wall_depth(after.mesh) - wall_depth(before.mesh), back, 1.5);
  const double area = 3.14 * std::pow(truth.radius, 2) / 1000;  // mm2, so that mm give ml
  const double more = after.fit.body_ml - before.fit.body_ml;
  EXPECT_GT(more, 0.5 * area * back);
  EXPECT_LT(more, 2 * area * back);
  // Skin and nipple do not follow the wall.
  EXPECT_LT((after.segmentation.labels.landmarks.at("nipple") -
             before.segmentation.labels.landmarks.at("nipple"))
                .norm(),
            2);
}

}  // namespace
}  // namespace breast
