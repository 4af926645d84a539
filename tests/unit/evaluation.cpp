// SPDX-License-Identifier: GPL-3.0-or-later
// Dice, surface distances and translated labels against shapes whose answers are known.
#include "evaluation/overlap.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "evaluation/curve_distance.hpp"
#include "evaluation/foreign_labels.hpp"
#include "evaluation/label_surface.hpp"
#include "evaluation/landmark_truth.hpp"
#include "evaluation/partial_volume.hpp"
#include "evaluation/shape_difference.hpp"
#include "evaluation/surface_distance.hpp"
#include "evaluation/truth_table.hpp"
#include "evaluation/wall_distance.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "mesh/locate.hpp"
#include "meshing/body_mesh.hpp"
#include "surface/triangle_tree.hpp"

namespace breast {
namespace {

Grid cube(int n, double spacing) {
  Grid grid;
  grid.size = {n, n, n};
  grid.spacing = Vec3::Constant(spacing);
  grid.origin = Vec3::Constant(spacing / 2);  // voxel corners at multiples of the spacing
  return grid;
}

// Fat in x < limit (mm), air elsewhere.
LabelVolume half(const Grid& grid, double limit) {
  LabelVolume labels;
  labels.grid = grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        labels.tissue.push_back(std::uint8_t(grid.to_patient(Vec3(i, j, k)).x() < limit));
      }
    }
  }
  return labels;
}

// A straight curve along y at x = offset with an arc beside it, in the plane z = height.
PolyLines straight_curve(double offset, double height) {
  PolyLines lines;
  lines.line_names = {"curve", "arc"};
  lines.lines.resize(2);
  for (int i = 0; i <= 10; ++i) {
    lines.lines[0].push_back(int(lines.points.size()));
    lines.points.emplace_back(offset, i, height);
  }
  for (int i = 0; i <= 10; ++i) {
    lines.lines[1].push_back(int(lines.points.size()));
    lines.points.emplace_back(10 * std::cos(0.1 * i), 10 * std::sin(0.1 * i), height);
  }
  lines.point_data["query"].assign(lines.points.size(), 0);
  return lines;
}

TEST(CurveDistance, IsMeasuredAlongTheDetector) {
  const CurveComparison comparison =
      compare_curves(straight_curve(2, 7), straight_curve(-1, -4), "given", "truth");
  EXPECT_EQ(comparison.curves, 1);
  EXPECT_NEAR(comparison.both.mean_mm, 3, 1e-9);
  EXPECT_NEAR(comparison.both.max_mm, 3, 1e-9);
}

TEST(CurveDistance, RefusesFilesWithoutACurve) {
  PolyLines none = straight_curve(0, 0);
  none.line_names[0] = "column in CC";
  EXPECT_THROW(compare_curves(none, straight_curve(0, 0), "given", "truth"), Error);
  PolyLines flat = straight_curve(0, 0);
  flat.lines.pop_back();
  flat.line_names.pop_back();
  EXPECT_THROW(compare_curves(flat, flat, "given", "truth"), Error);
}

TEST(Overlap, DiceOfShiftedHalves) {
  const Grid grid = cube(10, 2);
  const LabelOverlap same = compare_labels(half(grid, 10), half(grid, 10));
  EXPECT_EQ(same.breast.dice, 1);
  EXPECT_DOUBLE_EQ(same.breast.given_ml, 4);
  const LabelOverlap shifted = compare_labels(half(grid, 10), half(grid, 14));
  EXPECT_DOUBLE_EQ(shifted.tissue[1].dice, 2 * 5.0 / 12);
  EXPECT_DOUBLE_EQ(shifted.tissue[1].truth_ml, 5.6);
}

TEST(Overlap, AnotherGridAndACrop) {
  // Half the spacing: the same shape. A crop that misses part of the truth: it counts against it.
  EXPECT_DOUBLE_EQ(compare_labels(half(cube(10, 2), 10), half(cube(20, 1), 10)).breast.dice, 1);
  EXPECT_DOUBLE_EQ(compare_labels(half(cube(20, 1), 10), half(cube(10, 2), 10)).breast.dice, 1);
  Grid crop = cube(10, 2);
  crop.size[2] = 5;
  EXPECT_DOUBLE_EQ(compare_labels(half(crop, 10), half(cube(10, 2), 10)).breast.dice, 2 * 1.0 / 3);
}

// Fat in front of `wall` (mm along y), muscle behind.
LabelVolume walled(const Grid& grid, double wall) {
  LabelVolume labels;
  labels.grid = grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const bool front = grid.to_patient(Vec3(i, j, k)).y() < wall;
        labels.tissue.push_back(std::uint8_t(front ? Tissue::fat : Tissue::muscle));
      }
    }
  }
  return labels;
}

TEST(WallDistance, IsTheShiftAlongY) {
  const WallDistance moved = compare_walls(walled(cube(40, 1), 23), walled(cube(20, 2), 20));
  EXPECT_NEAR(moved.bias_mm, 3, 0.2);
  EXPECT_NEAR(moved.distance.mean_mm, 3, 0.2);
  EXPECT_NEAR(moved.distance.max_mm, 3, 0.2);
  EXPECT_EQ(moved.missing_percent, 0);
  EXPECT_EQ(moved.columns, 20 * 20);
  const WallDistance none = compare_walls(walled(cube(20, 2), 1e3), walled(cube(20, 2), 20));
  EXPECT_EQ(none.missing_percent, 100);
  EXPECT_EQ(none.columns_on_breast, 0);
  EXPECT_EQ(compare_walls(walled(cube(20, 2), 20), half(cube(20, 2), 20)).columns, 0)
      << "a true breast without muscle behind it has no wall";
}

TEST(WallDistance, OnTheBreastLeavesOutWhatIsNotLabelledBreast) {
  // The given wall is 2 mm too deep behind breast, where x < 20 mm, and 10 mm behind other tissue.
  LabelVolume given = walled(cube(40, 1), 22);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 20; i < 40; ++i)
        given.tissue[given.grid.offset(i, j, k)] = std::uint8_t(j < 20   ? Tissue::fat
                                                                : j < 30 ? Tissue::other
                                                                         : Tissue::muscle);
  const WallDistance all = compare_walls(given, walled(cube(20, 2), 20));
  EXPECT_NEAR(all.distance.mean_mm, 6, 0.3);
  EXPECT_NEAR(all.on_breast.mean_mm, 2, 0.2);
  EXPECT_NEAR(all.on_breast.max_mm, 2, 0.2);
  EXPECT_EQ(all.columns, 20 * 20);
  EXPECT_EQ(all.columns_on_breast, 10 * 20);
}

TEST(Overlap, GlandInTheBreastCountsHalfVoxelsHalf) {
  Grid grid = cube(1, 2);
  grid.size = {8, 1, 1};
  LabelVolume given = half(grid, 100), truth = given;
  //               both  missed  half found  half missed  false  tumour  beside the breast, twice
  given.tissue = {2, 1, 2, 1, 2, 2, 6, 6};
  truth.tissue = {2, 2, 1, 1, 1, 5, 2, 2};
  const std::vector<bool> of_half = {false, false, true, true, false, false, false, true};
  EXPECT_DOUBLE_EQ(gland_dice_in_breast(given, truth, of_half), 2 * 1.5 / (2.5 + 3));
  EXPECT_DOUBLE_EQ(gland_dice_in_breast(given, truth), 2 * 1.0 / (3 + 2));
  EXPECT_DOUBLE_EQ(gland_dice_in_breast(half(grid, 100), half(grid, 100)), 1);
}

TEST(Overlap, BodyCountsWhereBothHaveVoxels) {
  Grid crop = cube(10, 2);
  crop.size[2] = 5;
  const Overlap body = compare_labels(half(crop, 10), half(cube(10, 2), 12)).body;
  EXPECT_DOUBLE_EQ(body.dice, 2 * 5.0 / 11);
  EXPECT_DOUBLE_EQ(body.given_ml, 2);
  EXPECT_DOUBLE_EQ(body.truth_ml, 2.4);
}

TEST(PartialVolume, CeilingTakesTheFullestVoxels) {
  // 4 x 8 mm3: full, full, half, one per mille of gland; the best labelling takes the first three.
  Grid grid = cube(1, 2);
  grid.size = {4, 1, 1};
  Volume<float> fraction(grid);
  fraction.voxels = {1, 1, 0.5f, 0.001f};
  LabelVolume truth = half(grid, 100), given = truth;
  given.tissue = {2, 2, 1, 1};
  const PartialVolume result = compare_fractions(given, truth, fraction);
  EXPECT_NEAR(result.dice, 4 / (2 + 2.501), 1e-6);
  EXPECT_NEAR(result.ceiling, 5 / (3 + 2.501), 1e-6);
  EXPECT_NEAR(result.truth_ml, 2.501 * 0.008, 1e-6);
  for (float& f : fraction.voxels) f *= 255;
  EXPECT_NEAR(compare_fractions(given, truth, fraction).ceiling, result.ceiling, 1e-6);
}

TEST(Landmarks, SkinOverACode) {
  Volume<float> codes(cube(6, 2));
  codes.at(1, 1, 1) = codes.at(1, 3, 1) = 33;  // centre (3, 5, 3) mm; fat up to x = 8 mm
  const auto nipple = skin_over_code(codes, 33, half(codes.grid, 8));
  ASSERT_TRUE(nipple.has_value());
  EXPECT_LT((*nipple - Vec3(8, 5, 3)).norm(), 1e-12);
  EXPECT_FALSE(skin_over_code(codes, 34, half(codes.grid, 8)).has_value());
}

TEST(SurfaceDistance, PointToTriangle) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  EXPECT_DOUBLE_EQ(squared_distance({1, 1, 3}, a, b, c), 9);
  EXPECT_DOUBLE_EQ(squared_distance({2, -3, 0}, a, b, c), 9);
  EXPECT_DOUBLE_EQ(squared_distance({-3, -4, 0}, a, b, c), 25);
  EXPECT_DOUBLE_EQ(squared_distance({4, 4, 0}, a, b, c), 8);
  EXPECT_DOUBLE_EQ(squared_distance({0, 3, 4}, a, a, a), 25);
}

TEST(SurfaceDistance, TreeFindsTheNearest) {
  TriMesh mesh = breast_surface(half(cube(8, 1.5), 6));
  const TriangleTree tree(mesh);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x(i * 37 % 19 - 3.1, i * 53 % 17 - 2.2, i * 29 % 23 - 4.3);
    double best = 1e300;
    for (const auto& t : mesh.triangles) {
      best = std::min(
          best, squared_distance(x, mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])],
                                 mesh.points[std::size_t(t[2])]));
    }
    EXPECT_DOUBLE_EQ(tree.distance(x), std::sqrt(best));
  }
}

TEST(SurfaceDistance, ShiftedBoxes) {
  const Grid grid = cube(10, 2);
  const SurfaceComparison comparison =
      compare_surfaces(breast_surface(half(grid, 10)), breast_surface(half(grid, 14)));
  EXPECT_NEAR(comparison.from_truth.max_mm, 4, 1e-12);
  EXPECT_NEAR(comparison.to_truth.max_mm, 4, 1e-12);
  EXPECT_NEAR(comparison.both.max_mm, 4, 1e-12);
  EXPECT_GT(comparison.both.mean_mm, 0);
  EXPECT_LE(comparison.both.mean_mm, comparison.both.p95_mm);
  EXPECT_EQ(
      compare_surfaces(breast_surface(half(grid, 10)), breast_surface(half(grid, 10))).both.max_mm,
      0);
  EXPECT_THROW(compare_surfaces({}, breast_surface(half(grid, 10))), Error);
}

TEST(SurfaceDistance, PointSets) {
  TriMesh a, b;
  a.points = {{0, 0, 0}, {1, 0, 0}};
  b.points = {{0, 3, 0}, {1, 3, 0}, {1, 7, 0}};
  const SurfaceComparison comparison = compare_surfaces(a, b);
  EXPECT_DOUBLE_EQ(comparison.to_truth.mean_mm, 3);
  EXPECT_DOUBLE_EQ(comparison.from_truth.max_mm, 7);
  EXPECT_DOUBLE_EQ(comparison.from_truth.mean_mm, 13.0 / 3);
}

TEST(LabelSurface, IsClosedAndHasTheArea) {
  const TriMesh mesh = breast_surface(half(cube(10, 2), 10));
  double area = 0;
  Vec3 sum = Vec3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.points[std::size_t(t[0])];
    const Vec3 n =
        (mesh.points[std::size_t(t[1])] - a).cross(mesh.points[std::size_t(t[2])] - a) / 2;
    area += n.norm();
    sum += n.cwiseAbs();
  }
  EXPECT_DOUBLE_EQ(area, 2 * 20 * 20 + 4 * 20 * 10);
  EXPECT_DOUBLE_EQ(sum.x(), 2 * 20 * 20);
}

TEST(LandmarkTruth, ForeignTablesAreRefusedByFile) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      true_landmarks(parse_table(text, "t.tsv"), Side::left, "t.tsv");
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(refusal("landmark\tside\nnipple\tleft\n").starts_with("t.tsv: does not end"));
  EXPECT_TRUE(refusal("name\tvalue\na\t1\n\r\n").starts_with("t.tsv has no column"));
  EXPECT_TRUE(refusal("landmark\tside\nnipple\tleft\n\r\n").starts_with("t.tsv has no"));
  EXPECT_TRUE(refusal("landmark\tside\nnipple\tmiddle\n\r\n").starts_with("t.tsv: "));
  EXPECT_TRUE(refusal("landmark\tside\nnipple\tright\n\r\n").starts_with("t.tsv: no landmark"));
}

TEST(LandmarkTruth, ItsTumourIsNotTheChainsTumour) {
  const HexMesh mesh = analytic_breast_mesh(4);
  const Vec3 at = mesh.landmarks.front().imaged;
  const std::map<std::string, TruePosition> everywhere{
      {"stress_free", {at, {}}}, {"prone", {at, {}}}, {"supine", {at, {}}}};
  const Table table = compare_with_truth({mesh}, {{"nipple", everywhere}, {"tumour", everywhere}});
  EXPECT_EQ(table.rows[0][0], "nipple");
  EXPECT_EQ(table.rows[1][0], "true-tumour");
}

TEST(LandmarkTruth, ATableOfTwoPosturesIsEnough) {
  const HexMesh mesh = analytic_breast_mesh(4);
  Table table{{"landmark", "side", "prone_x_mm", "prone_y_mm", "prone_z_mm", "supine_x_mm",
               "supine_y_mm", "supine_z_mm"},
              {{"mark", std::string(side_name(mesh.side)), "0", "0", "0", "0", "3", "4"}}};
  const auto truth = true_landmarks(parse_table(table.closed_text(), "t.tsv"), mesh.side, "t.tsv");
  EXPECT_EQ(truth.front().at.size(), 2u);
  HexMesh supine = mesh;  // has not moved
  supine.reference = supine.imaged;
  supine.gravity = Vec3(0, 9810, 0);
  const Table errors = compare_with_truth({supine}, truth);
  EXPECT_EQ(errors.columns.back(), "supine_true_mm");
  EXPECT_EQ(errors.rows[0].back(), "5.000");
}

// A breast between plates 40 mm apart whose every point has moved by `by`.
HexMesh compressed(int n, const Vec3& by) {
  HexMesh mesh = analytic_breast_mesh(n);
  mesh.reference = mesh.imaged;
  for (Vec3& x : mesh.points) x += by;
  mesh.contact = ContactRecord{};
  mesh.contact->view = View::cc;
  mesh.contact->thickness_mm = 40;
  return mesh;
}

TEST(TruthTable, TheFinerMeshIsTheTruthAndItsDistanceToTheCoarserItsError) {
  HexMesh fine = compressed(6, Vec3(5, 0, 0)), coarse = compressed(4, Vec3(5, 0.3, 0));
  const Vec3 at = landmark_position(fine, fine.imaged, fine.landmarks.front());
  coarse.landmarks = {fine.landmarks.front()};
  const Location found = Locator(coarse, coarse.imaged).nearest(at);
  coarse.landmarks[0].element = found.element, coarse.landmarks[0].local = found.local;
  const Vec3 seen = landmark_position(coarse, coarse.imaged, coarse.landmarks[0]);

  Table imaged{{"landmark", "side"}, {{fine.landmarks[0].name, std::string(side_name(fine.side))}}};
  for (const char* posture : {"stress_free", "prone", "supine"})
    for (int d = 0; d < 3; ++d) {
      imaged.columns.push_back(std::string(posture) + std::array{"_x_mm", "_y_mm", "_z_mm"}[d]);
      imaged.rows[0].push_back(format_fixed(at[d], 6));
    }
  imaged = parse_table(imaged.closed_text(), "landmarks.tsv");
  const Table table = truth_table(imaged, {coarse, fine});
  const auto number = [&](const char* column) {
    return parse_number(table.rows[0][std::size_t(table.column(column))], column);
  };
  EXPECT_NEAR(number("cc_x_mm"), at.x() + 5, 1e-5);
  EXPECT_NEAR(number("cc_own_error_mm"), (seen + Vec3(0, 0.3, 0) - at).norm(), 1e-5);

  // Its reader gives what was written, and a chain's mesh is compared in that view.
  const auto truth = true_landmarks(parse_table(table.closed_text(), "t.tsv"), fine.side, "t.tsv");
  const HexMesh chain = compressed(5, Vec3(5, 0, 0.7));
  const Table errors = compare_with_truth({chain}, truth);
  const auto error = parse_number(errors.rows[0][std::size_t(errors.column("cc_error_mm"))], "cc");
  const double moved = parse_number(errors.rows[0][1], "outside");
  EXPECT_NEAR(error, 0.7, 0.002 + moved);
  EXPECT_EQ(errors.rows[0][std::size_t(errors.column("cc_own_error_mm"))],
            format_fixed(number("cc_own_error_mm"), 3));

  EXPECT_THROW(truth_table(imaged, {fine}), Error);
  coarse.contact->thickness_mm = 41;
  EXPECT_THROW(truth_table(imaged, {coarse, fine}), Error);
}

TEST(ForeignLabels, CodesAndRegion) {
  Volume<float> volume(cube(2, 1), 0.0f);
  volume.voxels = {0, 1, 29, 88, 0, 1, 29, 60};
  const TissueCodes codes = parse_tissue_codes({"1=fat", "29=fibroglandular", "88=fat"});
  LabelVolume labels = translate_labels(volume, codes, "truth.nrrd");
  const std::vector<std::uint8_t> expected = {0, 1, 2, 1, 0, 1, 2, 6};
  EXPECT_EQ(labels.tissue, expected);
  Volume<float> region(cube(2, 1), 2.0f);
  region.voxels[2] = 1;
  restrict_breast(labels, region, 2);
  EXPECT_EQ(labels.tissue[2], std::uint8_t(Tissue::other));
  EXPECT_EQ(labels.tissue[6], std::uint8_t(Tissue::fibroglandular));
  LabelVolume both = labels;
  both.tissue.assign(both.tissue.size(), std::uint8_t(Tissue::fat));
  restrict_to_side(both, Side::left, both.grid.to_patient(Vec3(0.5, 0, 0)).x());
  EXPECT_EQ(both.at(0, 0, 0), Tissue::other);
  EXPECT_EQ(both.at(1, 0, 0), Tissue::fat);
  EXPECT_THROW(translate_labels(volume, {}, "truth.nrrd"), Error);
  EXPECT_THROW(parse_tissue_codes({"29"}), Error);
  EXPECT_THROW(parse_tissue_codes({"29=gland"}), Error);
}

// Three meshes of one body with other elements; a deformation linear in place is exact in each.
TEST(ShapeDifference, FollowsThePlacesOfTheScanThroughOtherMeshes) {
  const auto model = [](int edge, double parameter) {
    HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(edge)});
    Mat3 slope;
    slope << 0.1, 0.02, 0, 0, -0.05, 0.03, 0.01, 0, 0.04;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      mesh.points[i] = mesh.imaged[i] + parameter * (slope * mesh.imaged[i] + Vec3(1, 2, 3));
    }
    return mesh;
  };
  const HexMesh base = model(6, 0), plus = model(8, 0.5), minus = model(7, -0.5);
  const ShapeDifference difference = shape_difference(base, plus, minus, 0.5);
  const ShapeDifference exact = shape_difference(base, model(6, 0.5), model(6, -0.5), 0.5);
  EXPECT_LT(exact.outside_mm, 1e-9);
  EXPECT_GT(difference.outside_mm, 1e-6);  // facets of other meshes
  const HexMesh unit = model(6, 1);
  int inside = 0;
  const Locator in_plus(plus, plus.imaged), in_minus(minus, minus.imaged);
  for (std::size_t i = 0; i < base.points.size(); ++i) {
    const Vec3 slope = unit.points[i] - base.points[i];
    EXPECT_LT((exact.per_node[i] - slope).norm(), 1e-8);
    if (!in_plus.find(base.imaged[i]) || !in_minus.find(base.imaged[i])) continue;
    EXPECT_LT((difference.per_node[i] - slope).norm(), 1e-8);
    ++inside;
  }
  EXPECT_GT(inside, base.nodes() / 3);
  HexMesh other = plus;
  other.side = Side::right;
  EXPECT_THROW(shape_difference(base, other, minus, 0.5), Error);
  for (Vec3& x : other.imaged) x.x() += 100;
  other.side = plus.side;
  EXPECT_THROW(shape_difference(base, other, minus, 0.5), Error);
  EXPECT_THROW(shape_difference(base, plus, minus, 0), Error);
}

}  // namespace
}  // namespace breast
