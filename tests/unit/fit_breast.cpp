// SPDX-License-Identifier: GPL-3.0-or-later
// From labels of an analytic hanging breast to its sheets and rim.
#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/error.hpp"
#include "fit/disc_map.hpp"
#include "fit/disc_surface.hpp"
#include "fit/fit_breast.hpp"
#include "fit/sheet_fit.hpp"
#include "fixtures/label_breast.hpp"
#include "surface/rim_border.hpp"

using namespace breast;
using breast::test::LabelBreast;

namespace {

struct Fitted {
  LabelBreast shape;
  FitReport report;
  BreastGeometry geometry;
};

Fitted fit(const LabelVolume& labels, const FitOptions& options = {}) {
  Fitted result;
  Timer timer;
  result.geometry = fit_breast(labels, options, result.report, timer);
  return result;
}

const LabelVolume& standard_labels() {
  static const LabelVolume labels = LabelBreast{}.labels();
  return labels;
}

/// A coarser skin surface: where the question is not accuracy.
FitOptions quick() {
  FitOptions options;
  options.surface_step_mm = 5;
  return options;
}

const Fitted& standard() {
  static const Fitted result = fit(standard_labels());
  return result;
}

std::vector<Vec2> inside_samples(const BreastGeometry& g) {
  std::vector<Vec2> samples;
  for (int j = 0; j <= 60; ++j)
    for (int i = 0; i <= 60; ++i)
      if (inside_star(g.rim_skin, g.centre, {i / 60.0, j / 60.0}))
        samples.push_back({i / 60.0, j / 60.0});
  return samples;
}

DiscSurface disc_of(const LabelVolume& labels) {
  const BreastRegion region = find_region(labels, 25);
  const OccupancyField field(labels, region.crop, 1.5, [](Tissue t) { return t != Tissue::air; });
  return extract_skin(field, region.crop, region.nipple, 3);
}

}  // namespace

TEST(DiscSurface, LiesOnTheSkinAndPointsOutwards) {
  const LabelBreast shape;
  const DiscSurface surface = disc_of(standard_labels());
  double sum = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) sum += shape.distance(surface.points[i]);
  EXPECT_LT(sum / double(surface.points.size()), 0.25);
  // Ball's front: normals are radial.
  const Vec3 centre(0, -shape.chest - shape.depth, -shape.drop);
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Vec3 radial = (surface.points[i] - centre).normalized();
    if (radial.y() < -0.5) {
      EXPECT_GT(radial.dot(surface.normals[i]), 0.95);
    }
  }
}

TEST(DiscSurface, IgnoresAirPocketsAndLooseIslands) {
  LabelVolume labels = standard_labels();
  const DiscSurface clean = disc_of(labels);
  const auto paint = [&](const Vec3& at, double radius, Tissue tissue) {
    for (int k = 0; k < labels.grid.size[2]; ++k)
      for (int j = 0; j < labels.grid.size[1]; ++j)
        for (int i = 0; i < labels.grid.size[0]; ++i)
          if ((labels.grid.to_patient(Vec3(i, j, k)) - at).norm() < radius)
            labels.tissue[labels.grid.offset(i, j, k)] = std::uint8_t(tissue);
  };
  paint({0, -60, 0}, 10, Tissue::air);
  paint({60, -90, 40}, 6, Tissue::other);
  const DiscSurface surface = disc_of(labels);
  EXPECT_EQ(surface.points.size(), clean.points.size());
  EXPECT_EQ(surface.triangles, clean.triangles);
}

TEST(DiscMap, IsOneToOneOnAShapeThatIsNoGraph) {
  const DiscSurface surface = disc_of(standard_labels());
  int overhang = 0;
  for (const Vec3& n : surface.normals) overhang += n.y() > 0.05;
  EXPECT_GT(overhang, 200);
  const DiscMap map = map_to_square(surface);
  EXPECT_EQ(map.flipped, 0);
  EXPECT_LT(map.area_ratio_p95, 2);
  EXPECT_GE(map.solves, 2);
}

TEST(FitBreast, SkinSheetMeetsTheTrueSkin) {
  const Fitted& f = standard();
  EXPECT_LE(f.report.skin_to_sheet.mean_mm, 0.2);
  EXPECT_LE(f.report.skin_to_sheet.p95_mm, 0.6);
  EXPECT_LE(f.report.skin_to_sheet.max_mm, 2.0);
  EXPECT_LE(f.report.sheet_to_skin.max_mm, 2.0);
  std::vector<double> truth;
  for (const Vec2& st : inside_samples(f.geometry))
    truth.push_back(f.shape.distance(f.geometry.skin.position(st)));
  const Distances summary = summarise(truth);
  EXPECT_LT(summary.mean_mm, 0.25);
  EXPECT_LT(summary.p95_mm, 0.7);
  EXPECT_LT(f.report.nipple_moved_mm, 1.5);
}

TEST(FitBreast, WallSheetMeetsTheTrueWall) {
  const Fitted& f = standard();
  for (const Vec2& st : f.geometry.rim_wall) {
    const Vec3 p = f.geometry.wall.position(st);
    EXPECT_NEAR(p.y(), f.shape.wall(p.x()), 0.8);
  }
  EXPECT_GT(f.report.wall_coverage, 0.99);
}

TEST(FitBreast, SheetsDoNotFoldAndFaceTheFront) {
  const BreastGeometry& g = standard().geometry;
  EXPECT_FALSE(check_folds(g.skin).folded());
  EXPECT_GT(standard().report.min_area_ratio, 0.05);
  EXPECT_LT(g.skin.evaluate(g.nipple_st).normal().y(), -0.9);
  EXPECT_LT(g.wall.evaluate({0.5, 0.5}).normal().y(), -0.9);
  // s towards +x, t towards +z on both sheets.
  for (const HermiteSheet* sheet : {&g.skin, &g.wall}) {
    EXPECT_GT(sheet->position({0.95, 0.5}).x(), sheet->position({0.05, 0.5}).x() + 50);
    EXPECT_GT(sheet->position({0.5, 0.95}).z(), sheet->position({0.5, 0.05}).z() + 50);
  }
}

TEST(FitBreast, RimIsStarShapedAndTheCutDoesNotCross) {
  const BreastGeometry& g = standard().geometry;
  ASSERT_GE(g.rim_skin.size(), 96u);
  ASSERT_EQ(g.rim_skin.size(), g.rim_wall.size());
  ASSERT_EQ(g.rim_skin.size(), g.rim_end.size());
  EXPECT_TRUE(star_shaped(g.rim_skin, g.centre));
  EXPECT_TRUE(star_shaped(g.rim_wall, centroid(g.rim_wall)));
  const std::size_t n = g.rim_skin.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 ray = g.rim_skin[i] - g.centre;
    EXPECT_NEAR(
        std::remainder(std::atan2(ray.y(), ray.x()) - 2 * std::numbers::pi * double(i) / double(n),
                       2 * std::numbers::pi),
        0, 1e-9);
    const Vec3 p = g.skin.position(g.rim_skin[i]), q = g.skin.position(g.rim_skin[(i + 1) % n]);
    const Vec3 u = g.wall.position(g.rim_wall[i]), v = g.wall.position(g.rim_wall[(i + 1) % n]);
    EXPECT_GT((q - p).dot(v - u), 0) << i;
    EXPECT_GT((u - p).y(), 5) << i;
  }
}

/// Where labels call less or more of the same body breast, the breast ends there.
TEST(FitBreast, RimFollowsTheBorderOfTheLabels) {
  for (const double wide : {58.0, 72.0}) {
    LabelVolume labels = standard_labels();
    for (int k = 0; k < labels.grid.size[2]; ++k) {
      for (int j = 0; j < labels.grid.size[1]; ++j) {
        for (int i = 0; i < labels.grid.size[0]; ++i) {
          std::uint8_t& tissue = labels.tissue[labels.grid.offset(i, j, k)];
          const Vec3 p = labels.grid.to_patient(Vec3(i, j, k));
          if (tissue == std::uint8_t(Tissue::air) || tissue == std::uint8_t(Tissue::muscle))
            continue;
          tissue = std::uint8_t(std::hypot(p.x(), p.z()) < wide ? Tissue::fat : Tissue::other);
        }
      }
    }
    const Fitted f = fit(labels, quick());
    const BreastGeometry& g = f.geometry;
    double mean = 0;
    for (std::size_t i = 0; i < g.rim_skin.size(); ++i) {
      const Vec3 p = g.skin.position(g.rim_skin[i]);
      const double radius = std::hypot(p.x(), p.z());
      EXPECT_NEAR(radius, wide, 5) << i;
      mean += radius / double(g.rim_skin.size());
    }
    EXPECT_NEAR(mean, wide, 1.5);
    EXPECT_LT(std::abs(f.report.rim.beyond_labels_median_mm), 2);
    EXPECT_EQ(rim_borders(g)[0], RimBorder::lateral);
  }
}

TEST(FitBreast, BodyHasTheBreastsVolumeAndAClosedBoundary) {
  const Fitted& f = standard();
  EXPECT_NEAR(f.report.body_ml / f.report.label_ml, 1, 0.05);
  const BoundaryMesh mesh = boundary_mesh(f.geometry);
  Vec3 sum = Vec3::Zero();
  for (const auto& t : mesh.triangles)
    sum += (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
  EXPECT_LT(sum.norm(),
            30);  // mm^2: the rims' ends of fan and cut agree only to rounding of the fan
  EXPECT_GT(enclosed_volume(f.geometry), 0);
}

TEST(FitBreast, AnswerDoesNotDependOnThreads) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Fitted one = fit(standard_labels());
  omp_set_num_threads(threads);
  for (std::size_t i = 0; i < one.geometry.skin.nodes.size(); ++i)
    EXPECT_EQ(one.geometry.skin.nodes[i].x, standard().geometry.skin.nodes[i].x);
  for (std::size_t i = 0; i < one.geometry.rim_wall.size(); ++i)
    EXPECT_EQ(one.geometry.rim_wall[i], standard().geometry.rim_wall[i]);
}

TEST(FitBreast, MaxErrorRefines) {
  FitOptions options = quick();
  options.patches_s = options.patches_t = 6;
  const Fitted coarse = fit(standard_labels(), options);
  options.max_error_mm = 0.7 * coarse.report.whole_skin_to_sheet.max_mm;
  const Fitted fine = fit(standard_labels(), options);
  EXPECT_GT(fine.report.patches_s, 6);
  EXPECT_LE(fine.report.whole_skin_to_sheet.max_mm, options.max_error_mm);
}

TEST(FitBreast, MoreSmoothingFitsWorse) {
  FitOptions options = quick();
  options.smoothing = 1e-5;
  const Fitted smooth = fit(standard_labels(), options);
  EXPECT_EQ(smooth.report.smoothing, 1e-5);
  EXPECT_GT(smooth.report.rms_mm, standard().report.rms_mm);
}

TEST(FitBreast, RightSideIsTheMirrorCase) {
  LabelVolume labels = standard_labels();
  labels.side = Side::right;
  const Fitted f = fit(labels, quick());
  EXPECT_EQ(f.geometry.side, Side::right);
  EXPECT_LE(f.report.skin_to_sheet.mean_mm, 0.2);
  EXPECT_TRUE(star_shaped(f.geometry.rim_wall, centroid(f.geometry.rim_wall)));
}

TEST(FitBreast, RefusesWhatHoldsNoBreast) {
  LabelVolume labels = standard_labels();
  const auto expect_input = [](const LabelVolume& bad, const std::string& word) {
    try {
      fit(bad, quick());
      FAIL() << "accepted: " << word;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  LabelVolume empty = labels;
  std::fill(empty.tissue.begin(), empty.tissue.end(), std::uint8_t(0));
  expect_input(empty, "0 ml");
  LabelVolume no_wall = labels;
  for (auto& t : no_wall.tissue)
    if (t == std::uint8_t(Tissue::muscle)) t = std::uint8_t(Tissue::other);
  expect_input(no_wall, "chest wall");
  LabelVolume no_air = labels;
  for (auto& t : no_air.tissue)
    if (t == 0) t = std::uint8_t(Tissue::other);
  expect_input(no_air, "front");
  LabelVolume lost = labels;
  lost.landmarks["nipple"].x() = std::nan("");
  expect_input(lost, "nipple");
  LabelVolume cut = labels;
  cut.tissue.pop_back();
  expect_input(cut, "voxels");
}
