// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/segment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "core/report.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "segment/grid/grid_ops.hpp"
#include "segment/wall/min_cut.hpp"

namespace breast {
namespace {

using testing::SyntheticScan;

Segmentation run(const Volume<float>& scan, const SegmentOptions& options) {
  Timer timer;
  return segment_breast(scan, options, no_progress(), timer);
}

bool is_breast(std::uint8_t tissue) {
  return tissue >= 1 && tissue <= 3;
}

struct Scores {
  double breast_dice = 0, gland_dice = 0, wall_mean = 0, wall_p95 = 0;
  int gaps = 0;  ///< columns of the breast without muscle right behind it
};

Scores score(const SyntheticScan& truth, const LabelVolume& labels, double side) {
  Scores scores;
  double both = 0, ours = 0, theirs = 0, gland_both = 0, gland_ours = 0, gland_theirs = 0;
  std::vector<double> wall;
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      int last_breast = -1;
      for (int j = 0; j < grid.size[1]; ++j) {
        const Vec3 p = grid.to_patient(Vec3(i, j, k));
        const std::uint8_t tissue = labels.tissue[grid.offset(i, j, k)];
        const bool a = is_breast(tissue);
        const bool b = p[0] * side > 0 && !truth.behind_wall(p) && truth.in_ellipsoid(p, 1);
        const bool g = p[0] * side > 0 && truth.in_gland(p);
        ours += a;
        theirs += b;
        both += a && b;
        gland_ours += tissue == 2;
        gland_theirs += g;
        gland_both += g && tissue == 2;
        if (a) last_breast = j;
      }
      if (last_breast < 0) continue;
      const Vec3 edge = grid.to_patient(Vec3(i, last_breast + 0.5, k));
      const bool muscle_next =
          last_breast + 1 < grid.size[1] && labels.at(i, last_breast + 1, k) == Tissue::muscle;
      const bool stands =
          truth.in_ellipsoid(Vec3(edge[0], truth.wall(edge[0], edge[2]) - 1, edge[2]), 0.9);
      if (!stands) continue;
      scores.gaps += !muscle_next;
      wall.push_back(std::abs(edge[1] - truth.wall(edge[0], edge[2])));
    }
  }
  scores.breast_dice = 2 * both / (ours + theirs);
  scores.gland_dice = 2 * gland_both / (gland_ours + gland_theirs);
  std::sort(wall.begin(), wall.end());
  for (const double w : wall) scores.wall_mean += w / double(wall.size());
  scores.wall_p95 = wall[std::size_t(0.95 * double(wall.size() - 1))];
  return scores;
}

TEST(Segment, KnownBreastUnderFivefoldBias) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  for (const Side side : {Side::left, Side::right}) {
    SegmentOptions options;
    options.side = side;
    const double sign = lateral_sign(side);
    const Segmentation result = run(scan, options);
    const Scores scores = score(truth, result.labels, sign);
    SCOPED_TRACE(std::string(side_name(side)) +
                 ::testing::PrintToString(std::vector<double>{
                     scores.breast_dice, scores.gland_dice, scores.wall_mean, scores.wall_p95,
                     result.bias_cv_before, result.bias_cv_after, result.bias_range}));
    EXPECT_EQ(result.labels.side, side);
    EXPECT_GT(scores.breast_dice, 0.93);
    EXPECT_GT(scores.gland_dice, 0.90);
    EXPECT_EQ(scores.gaps, 0);
    EXPECT_LT(scores.wall_mean, 0.8);  // voxels are 2 mm deep
    EXPECT_LT(scores.wall_p95, 1.6);
    EXPECT_GT(result.bias_cv_before, 0.3);
    EXPECT_LT(result.bias_cv_after, 0.07);
    EXPECT_GT(result.bias_range, 3);
    EXPECT_NEAR(result.midline_mm, 0, 3);
    EXPECT_LT((result.labels.landmarks.at("nipple") - truth.nipple(sign)).norm(), 7);
    EXPECT_GT(result.fibroglandular_agreement, 0.8);
    EXPECT_GT(result.wall_confident_percent, 90);
  }
}

TEST(Segment, ABreastWithoutGlandHasNone) {
  SyntheticScan truth;
  truth.gland_scale = 0;
  SegmentOptions options;
  const Segmentation result = run(truth.image(), options);
  double gland = 0, fat = 0;
  for (const auto tissue : result.labels.tissue) {
    gland += tissue == 2;
    fat += tissue == 1;
  }
  EXPECT_LT(gland, 0.03 * fat);
}

TEST(Segment, AxesInAnyOrderGiveTheSameBreast) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  // As a sagittal acquisition stored from top to bottom: (j, k flipped, i).
  Volume<float> sagittal;
  const auto& size = scan.grid.size;
  sagittal.grid.size = {size[1], size[2], size[0]};
  sagittal.grid.spacing = Vec3(2, 4, 2);
  sagittal.grid.direction << 0, 0, 1, 1, 0, 0, 0, -1, 0;
  sagittal.grid.origin = scan.grid.to_patient(Vec3(0, 0, size[2] - 1));
  sagittal.voxels.resize(scan.voxels.size());
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) sagittal.at(j, size[2] - 1 - k, i) = scan.at(i, j, k);
    }
  }
  const Volume<float> back = in_patient_order(sagittal);
  EXPECT_EQ(back.grid.size, scan.grid.size);
  EXPECT_LT((back.grid.origin - scan.grid.origin).norm(), 1e-9);
  EXPECT_TRUE(back.grid.direction.isIdentity(1e-12));
  EXPECT_EQ(back.voxels, scan.voxels);
}

// Patient y of the labels' chest wall.
double wall_at(const LabelVolume& labels, double x, double z) {
  const Vec3 index = labels.grid.to_index(Vec3(x, labels.grid.origin[1], z));
  const int i = int(std::lround(index[0])), k = int(std::lround(index[2]));
  int j = 0;
  while (j < labels.grid.size[1] && labels.at(i, j, k) != Tissue::muscle) ++j;
  return labels.grid.to_patient(Vec3(i, j - 0.5, k))[1];
}

TEST(Segment, ClickedPointsMoveTheWallThere) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  SegmentOptions options;
  const Vec3 click(75, truth.wall(75, 0) - 9, 0);
  options.wall_points = {click};
  const LabelVolume labels = run(scan, options).labels;
  EXPECT_NEAR(wall_at(labels, 75, 0), click[1], 2);
  EXPECT_NEAR(wall_at(labels, 20, 0), truth.wall(20, 0), 2) << "far from the click nothing moves";
  options.wall_points = {Vec3(75, 0, 500)};
  EXPECT_THROW(run(scan, options), Error);
}

// Thousands of points are a surface in a table: their number does not make the system larger.
TEST(Segment, AnyNumberOfClickedPointsIsTaken) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  SegmentOptions options;
  const double moved = 6;
  for (double z = -40; z <= 40; z += 1) {
    for (double x = 40; x <= 110; x += 0.5) {
      options.wall_points.emplace_back(x, truth.wall(x, z) - moved, z);
    }
  }
  ASSERT_GT(options.wall_points.size(), 10000u);
  const double start = cpu_seconds();
  const LabelVolume labels = run(scan, options).labels;
  EXPECT_LT(cpu_seconds() - start, 20);  // a dense system of so many takes an hour
  for (const double x : {60, 75, 90})
    EXPECT_NEAR(wall_at(labels, x, 0), truth.wall(x, 0) - moved, 2) << x;
}

TEST(Segment, ASurfaceReplacesTheWallAndMayReachBeyondIt) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  SegmentOptions options;
  options.wall_points_of_surface = true;
  const double moved = 6;
  for (double z = -300; z <= 300; z += 3) {
    for (double x = -100; x <= 200; x += 3) {
      options.wall_points.emplace_back(x, truth.wall(x, z) - moved, z);
    }
  }
  const Scores scores = score(truth, run(scan, options).labels, 1);
  EXPECT_GT(scores.wall_mean, 0.7 * moved);
  EXPECT_LT(scores.wall_mean, 1.3 * moved);
  options.wall_points = {Vec3(75, 0, 500)};
  EXPECT_THROW(run(scan, options), Error);
}

TEST(Segment, RegionGrowingMakesTheLabelsWhenAskedTo) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  const auto gland = [](const Segmentation& result) {
    double fibroglandular = 0, interior = 0;
    for (const std::uint8_t code : result.labels.tissue) {
      fibroglandular += code == std::uint8_t(Tissue::fibroglandular);
      interior += code == std::uint8_t(Tissue::fibroglandular) || code == std::uint8_t(Tissue::fat);
    }
    return fibroglandular / interior;
  };
  const Segmentation by_threshold = run(scan, SegmentOptions{});
  SegmentOptions growing;
  growing.interior = Interior::region_growing;
  const Segmentation grown = run(scan, growing);
  EXPECT_EQ(by_threshold.fat_fraction_grown, grown.fat_fraction_grown);
  EXPECT_NE(by_threshold.labels.tissue, grown.labels.tissue);
  for (const float fraction : grown.labels.fibroglandular_fraction) {
    ASSERT_TRUE(fraction == 0 || fraction == 1);
  }
  EXPECT_NEAR(gland(grown), 1 - grown.fat_fraction_grown, 0.05);
  EXPECT_NEAR(gland(by_threshold), 1 - by_threshold.fat_fraction, 0.05);
}

TEST(Segment, ACorrectedLabelMapReplacesTheWall) {
  const SyntheticScan truth;
  const Volume<float> scan = truth.image();
  SegmentOptions options;
  options.wall_labels = Volume<float>(truth.grid);
  const double moved = 6;
  for (int k = 0; k < truth.grid.size[2]; ++k) {
    for (int j = 0; j < truth.grid.size[1]; ++j) {
      for (int i = 0; i < truth.grid.size[0]; ++i) {
        const Vec3 p = truth.grid.to_patient(Vec3(i, j, k));
        if (p[1] >= truth.wall(p[0], p[2]) - moved) options.wall_labels->at(i, j, k) = 4;
      }
    }
  }
  SyntheticScan shifted = truth;
  const Scores scores = score(shifted, run(scan, options).labels, 1);
  EXPECT_NEAR(scores.wall_mean, moved, 1.5);
  std::fill(options.wall_labels->voxels.begin(), options.wall_labels->voxels.end(), 0.0f);
  EXPECT_THROW(run(scan, options), Error);
}

// Somebody's muscle is measured muscle: behind it there is none.
TEST(Segment, TheBackOfAGivenMuscleIsKept) {
  const SyntheticScan truth;
  const double thick = 10;
  const auto labels_of = [&](double thickness, double& percent) {
    SegmentOptions options;
    options.wall_labels = Volume<float>(truth.grid);
    for (int k = 0; k < truth.grid.size[2]; ++k) {
      for (int j = 0; j < truth.grid.size[1]; ++j) {
        for (int i = 0; i < truth.grid.size[0]; ++i) {
          const Vec3 p = truth.grid.to_patient(Vec3(i, j, k));
          const double depth = p[1] - truth.wall(p[0], p[2]);
          if (depth >= 0 && depth < thickness) options.wall_labels->at(i, j, k) = 4;
        }
      }
    }
    const Segmentation result = run(truth.image(), options);
    percent = result.muscle_back_percent.value();
    return result.labels;
  };
  double percent = 0, without_back = 0;
  const LabelVolume thin = labels_of(thick, percent), whole = labels_of(1000, without_back);
  EXPECT_GT(percent, 90);
  EXPECT_EQ(without_back, 0);
  const Grid& grid = thin.grid;
  double muscle = 0, columns = 0;
  for (std::size_t n = 0; n < thin.tissue.size(); ++n) {
    if (thin.tissue[n] == whole.tissue[n]) continue;
    ASSERT_EQ(thin.tissue[n], std::uint8_t(Tissue::other));
    ASSERT_EQ(whole.tissue[n], std::uint8_t(Tissue::muscle));
  }
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      double run_mm = 0;
      bool ends = false;
      for (int j = 0; j < grid.size[1]; ++j) {
        run_mm += thin.at(i, j, k) == Tissue::muscle ? grid.spacing[1] : 0;
        ends = ends || (run_mm > 0 && thin.at(i, j, k) == Tissue::other);
      }
      muscle += ends ? run_mm : 0;
      columns += ends;
    }
  }
  ASSERT_GT(columns, 0);
  EXPECT_NEAR(muscle / columns, thick, 1.5);
}

TEST(Segment, ScansWithoutABreastAreRefusedInOneLine) {
  const auto refusal = [](const Volume<float>& scan) -> std::string {
    try {
      run(scan, SegmentOptions{});
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      return error.what();
    }
    return "";
  };
  SyntheticScan flat;
  flat.depth = 0;
  EXPECT_NE(refusal(flat.image()).find("breast"), std::string::npos);
  Volume<float> uniform(flat.grid, 7.0f);
  EXPECT_NE(refusal(uniform), "");
  std::mt19937 random(3);
  Volume<float> noise(flat.grid);
  for (float& v : noise.voxels) v = float(random() % 100);
  EXPECT_NE(refusal(noise), "");
}

TEST(Segment, AWallInsideTheBreastIsRefused) {
  // As dark as muscle, the back half of the breast is taken for it.
  const SyntheticScan truth = SyntheticScan::coarse();
  const double sternal_skin = truth.wall(0, 0) - SyntheticScan::fat_layer;
  const Volume<float> scan = truth.image_of([&](const Vec3& p) {
    const double signal = truth.signal(p);
    return signal > 0.35 && p[1] > sternal_skin - 18 && truth.in_ellipsoid(p, 0.95) ? 0.35 : signal;
  });
  try {
    run(scan, SegmentOptions{});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_EQ(std::string(error.what()).find("the chest wall was found inside the breast"), 0u)
        << error.what();
  }
}

/// Exact answer on a single row by dynamic programming; a level outside a column's range is
/// infinitely expensive.
double chain_optimum(const SurfaceProblem& problem, int levels) {
  const double never = std::numeric_limits<double>::infinity();
  const auto cost = [&](int column, int d) -> double {
    const int n = d - problem.top[column];
    return n < 0 || n >= problem.levels(column) ? never : problem.cost[problem.first[column] + n];
  };
  std::vector<double> best(levels), next(levels);
  for (int d = 0; d < levels; ++d) best[d] = cost(0, d);
  for (int i = 1; i < problem.nx; ++i) {
    for (int d = 0; d < levels; ++d) {
      next[d] = never;
      for (int e = 0; e < levels; ++e) {
        if (std::abs(d - e) > problem.max_step_x) continue;
        next[d] = std::min(next[d], best[e] + problem.step_cost_x * std::abs(d - e));
      }
      next[d] += cost(i, d);
    }
    best = next;
  }
  return *std::min_element(best.begin(), best.end());
}

// `wander` is by how much the range of levels moves from column to column at most.
void expect_optimum_on_a_row(int range, int wander) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-1, 1);
  SurfaceProblem problem;
  problem.nx = 40;
  problem.nz = 1;
  problem.max_step_x = 2;
  problem.step_cost_x = 0.2;
  problem.first = {0};
  for (int i = 0; i < problem.nx; ++i) {
    const int before = i > 0 ? problem.top.back() : 20, move = int(random() % (2 * wander + 1));
    problem.top.push_back(std::max(0, before + move - wander));
    for (int n = 0; n < range; ++n) problem.cost.push_back(uniform(random));
    problem.first.push_back(problem.cost.size());
  }
  const std::vector<int> surface = optimal_surface(problem);
  double cost = 0;
  for (int i = 0; i < problem.nx; ++i) {
    ASSERT_GE(surface[i], problem.top[i]);
    ASSERT_LT(surface[i], problem.top[i] + range);
    cost += problem.cost[problem.first[i] + surface[i] - problem.top[i]];
    if (i == 0) continue;
    ASSERT_LE(std::abs(surface[i] - surface[i - 1]), problem.max_step_x);
    cost += problem.step_cost_x * std::abs(surface[i] - surface[i - 1]);
  }
  EXPECT_NEAR(cost, chain_optimum(problem, 120), 1e-5) << range << " " << wander;
}

TEST(MinCut, EqualsDynamicProgrammingOnARow) {
  for (const int range : {1, 2, 3, 9}) expect_optimum_on_a_row(range, 0);
}

TEST(MinCut, EveryColumnHasARangeOfItsOwn) {
  for (const int range : {2, 3, 9}) expect_optimum_on_a_row(range, 2);
}

}  // namespace
}  // namespace breast
