// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/fit_breast.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fit/closest_point.hpp"
#include "fit/rim.hpp"
#include "fit/skin_sheet.hpp"
#include "surface/triangle_tree.hpp"

namespace breast {

namespace {

/// Where the body touches the anterior end of the field of view, its skin was not imaged.
void check_front(const DiscSurface& surface, double front, FitReport& report) {
  double cut = 0, total = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    total += surface.areas[i];
    if (surface.points[i].y() < front + 1.5) cut += surface.areas[i];
  }
  const double percent = 100 * cut / total;
  if (percent > 10)
    throw input_error("labels: the body touches the front end of the field of view over ", percent,
                      " % of its skin; at most 10 % can be bridged; the scan or the crop "
                      "truncates the breast");
  if (percent > 0.1)
    report.doubts.push_back(message("the front end of the field of view cuts off ", percent,
                                    " % of the skin: the fitted skin is flat there"));
}

/// The skin as a disc; a ragged mask is smoothed more and cropped closer before it is refused.
DiscSurface skin_surface(const LabelVolume& labels, BreastRegion& region, const FitOptions& options,
                         FitReport& report) {
  const auto body = [](Tissue t) { return t != Tissue::air; };
  const double attempts[][2] = {{1.5, 1.0}, {2.0, 1.0}, {2.5, 1.0}, {3.0, 1.0},
                                {1.5, 0.5}, {3.0, 0.5}, {4.5, 0.25}};
  std::string reason;
  for (const auto& [smoothing, part] : attempts) {
    region = find_region(labels, part * options.margin_mm);
    try {
      const OccupancyField field(labels, region.crop, smoothing, body);
      DiscSurface surface =
          extract_skin(field, region.crop, region.nipple, options.surface_step_mm);
      check_front(surface, field.front(), report);
      if (!reason.empty())
        report.mended.push_back(message("the skin was smoothed by ", smoothing, " mm and cropped ",
                                        part * options.margin_mm,
                                        " mm beyond the breast to obtain the topology of a "
                                        "disc: ",
                                        reason));
      return surface;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::input) throw;
      if (reason.empty()) reason = error.what();
    }
  }
  throw Error(ErrorKind::input, reason);
}

void measure_fit(const DiscSurface& surface, const SheetData& data, const BreastGeometry& geometry,
                 FitReport& report) {
  const auto inside = [&](const Vec2& st) {
    return inside_star(geometry.rim_skin, geometry.centre, st);
  };
  const auto measured = measured_points(geometry.skin, data, surface, inside);
  report.skin_to_sheet = summarise(distances_of(measured));
  const auto worst =
      std::max_element(measured.begin(), measured.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
  if (worst != measured.end()) report.worst_point = worst->second;
  std::vector<Vec3> samples;
  const int n = 8 * std::max(geometry.skin.nu, geometry.skin.nv);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vec2 st(double(i) / n, double(j) / n);
      if (inside(st)) samples.push_back(geometry.skin.position(st));
    }
  TriMesh skin;
  skin.points = surface.points;
  skin.triangles = surface.triangles;
  const TriangleTree tree(skin);
  std::vector<double> distances(samples.size());
#pragma omp parallel for num_threads(threads()) schedule(dynamic, 64)
  for (std::size_t k = 0; k < samples.size(); ++k) distances[k] = tree.distance(samples[k]);
  report.sheet_to_skin = summarise(distances);
}

void find_doubts(const BreastRegion& region, const BreastGeometry& geometry, FitReport& report) {
  const auto doubt = [&](const auto&... parts) { report.doubts.push_back(message(parts...)); };
  if (!report.target_reached)
    doubt("the skin's rms distance is ", report.rms_mm,
          " mm, above the target; more --elements help");
  if (report.skin_to_sheet.max_mm > 2)
    doubt("the skin's largest distance to its sheet is ", report.skin_to_sheet.max_mm, " mm");
  if (!region.nipple_known)
    doubt("the labels have no nipple landmark; the most anterior point is used instead");
  if (report.nipple_moved_mm > 5)
    doubt("the nipple landmark lies ", report.nipple_moved_mm, " mm from the skin sheet");
  if (report.wall_coverage < 0.9)
    doubt("the chest wall is visible behind only ", 100 * report.wall_coverage, " % of the breast");
  if (report.thorax.wall_p95_mm > 8)
    doubt("beside the breast the wall surface lies up to ", report.thorax.wall_p95_mm,
          " mm (95th percentile) from the labels' chest wall: check the labels before letting "
          "the breast slide on it");
  if (report.filled_points > 0)
    doubt("the skin leaves the field of view inside the breast's outline: ", report.filled_points,
          " hole(s) are bridged by the smooth sheet");
  const double margin =
      double(std::count(geometry.rim_end.begin(), geometry.rim_end.end(), RimEnd::margin)) /
      double(geometry.rim_end.size());
  // A breast that continues into the axilla ends there on ordinary scans, along a tenth to a half
  // of the rim on eight of ours.
  if (margin > 0.5)
    doubt(std::lround(100 * margin),
          " % of the rim lies at the border of the sheet rather than at that of the breast "
          "(field of view, midline, or tissue that does not become thinner)");
  if (report.rim.skin_angle_min < 30 || report.rim.wall_angle_min < 30)
    doubt("sharp rim: ", std::lround(report.rim.skin_angle_min), " degrees at the skin, ",
          std::lround(report.rim.wall_angle_min), " at the wall");
  // Elements beside a rim of 177 degrees were as well shaped as others (scaled Jacobian 0.7).
  if (report.rim.skin_angle_max > 178 || report.rim.wall_angle_max > 178)
    doubt("flat rim: ", std::lround(report.rim.skin_angle_max), " degrees at the skin, ",
          std::lround(report.rim.wall_angle_max), " at the wall");
}

void check_options(const FitOptions& options) {
  const auto check = [](double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high))
      throw input_error(what, " ", value, ": must lie in ", low, "..", high);
  };
  check(options.patches_s, 3, 40, "patches along s");
  check(options.patches_t, 3, 40, "patches along t");
  check(options.smoothing, 0, 1, "smoothing");
  check(options.max_error_mm, 0, 100, "largest error (mm)");
  check(options.target_rms_mm, 0.01, 10, "target rms (mm)");
  check(options.target_max_mm, 0.01, 100, "target of the largest distance (mm)");
  check(options.most_patches, 3, 40, "most patches a side");
  check(options.margin_mm, 5, 100, "margin (mm)");
  check(options.surface_step_mm, 0.5, 10, "surface raster (mm)");
  check(options.wall_smoothing_mm, 1, 50, "wall smoothing (mm)");
  check(options.rays.rays, 32, 1024, "rim rays");
  check(options.rays.margin.width, 0.01, 0.3, "rim margin");
}

/// The state of a fit, in which every step stores its results for the next ones.
struct Fit {
  const LabelVolume& labels;
  const FitOptions& options;
  FitReport& report;
  Timer& timer;
  Progress& progress;
  BreastRegion region;
  DiscSurface surface;
  DiscMap map;
  SheetData data;
  WallSheet wall;
  BreastGeometry geometry;
};

void find_surface(Fit& fit) {
  const Timer::Scope phase(fit.timer, "skin surface");
  fit.progress.update("skin surface", 0, "");
  fit.surface = skin_surface(fit.labels, fit.region, fit.options, fit.report);
  const std::vector<char>& filled = fit.surface.filled;
  fit.report.data_points = fit.surface.points.size();
  fit.report.filled_points = std::size_t(std::count(filled.begin(), filled.end(), char(1)));
  fit.report.label_ml = fit.region.breast_ml;
}

void find_map(Fit& fit) {
  const Timer::Scope phase(fit.timer, "map to square");
  fit.progress.update("map to square", 0.2, message(fit.surface.points.size(), " points"));
  fit.map = map_to_square(fit.surface);
  fit.report.area_ratio_p95 = fit.map.area_ratio_p95;
}

void find_skin_sheet(Fit& fit) {
  const Timer::Scope phase(fit.timer, "skin sheet");
  SkinSheet skin =
      fit_skin(fit.surface, fit.map, fit.region.nipple, fit.options, fit.report, fit.progress);
  fit.geometry.skin = std::move(skin.outcome.sheet);
  fit.data = std::move(skin.data);
  fit.report.smoothing = skin.outcome.smoothing;
  fit.report.rms_mm = skin.outcome.rms_mm;
  fit.report.loops = skin.outcome.loops;
  fit.report.target_reached = skin.outcome.reached || fit.options.smoothing > 0;
  const FoldCheck folds = check_folds(fit.geometry.skin);
  fit.report.min_normal_cosine = folds.min_cosine;
  fit.report.min_area_ratio = folds.min_area_ratio;
}

void find_wall_sheet(Fit& fit) {
  const Timer::Scope phase(fit.timer, "wall sheet");
  fit.progress.update("wall sheet", 0.7, "");
  fit.wall = fit_wall(fit.labels, fit.region, fit.options.patches_s, fit.options.patches_t,
                      fit.options.wall_smoothing_mm);
  fit.geometry.wall = fit.wall.sheet;
  fit.report.wall_rms_mm = fit.wall.rms_mm;
  fit.report.wall_p95_mm = fit.wall.residual_p95_mm;
  fit.report.wall_coverage = fit.wall.coverage;
}

void find_rim(Fit& fit) {
  const Timer::Scope phase(fit.timer, "rim");
  fit.progress.update("rim", 0.85, "");
  BreastGeometry& geometry = fit.geometry;
  const SheetFoot nipple = SheetLocator(geometry.skin, 4).closest(fit.region.nipple);
  geometry.nipple_st = nipple.st;
  geometry.nipple = nipple.x;
  fit.report.nipple_moved_mm = fit.region.nipple_known ? nipple.distance : 0;
  const BreastShare share(fit.labels, fit.region.crop);
  const RimRays rays =
      walk_rim(geometry.skin, fit.wall, share, geometry.side, geometry.nipple_st, fit.options.rays);
  Rim& rim = fit.report.rim;
  rim = lay_rim(geometry.skin, fit.wall, rays, fit.options.rays.margin);
  geometry.centre = rim.centre;
  geometry.rim_skin = rim.skin;
  geometry.rim_wall = rim.wall;
  geometry.rim_end = rim.end;
  if (rim.wider_mm != 0)
    fit.report.mended.push_back(
        message("the rim was moved ", std::abs(rim.wider_mm), " mm ",
                rim.wider_mm > 0 ? "outwards" : "inwards",
                ", because no straight cut could be laid at the border of the labelled breast"));
}

void find_thorax(Fit& fit) {
  const Timer::Scope phase(fit.timer, "wall surface");
  fit.progress.update("wall surface", 0.92, "");
  fit.geometry.thorax = fit_thorax(fit.labels, fit.geometry, fit.report.thorax);
}

void judge(Fit& fit) {
  const Timer::Scope phase(fit.timer, "distances");
  fit.progress.update("distances", 0.95, "");
  BreastGeometry& geometry = fit.geometry;
  measure_fit(fit.surface, fit.data, geometry, fit.report);
  fit.report.body_ml = enclosed_volume(geometry) * 1e-3;
  geometry.fit_mean_mm = fit.report.skin_to_sheet.mean_mm;
  geometry.fit_p95_mm = fit.report.skin_to_sheet.p95_mm;
  geometry.fit_max_mm = fit.report.skin_to_sheet.max_mm;
  find_doubts(fit.region, geometry, fit.report);
}

}  // namespace

BreastGeometry fit_breast(const LabelVolume& labels, const FitOptions& options, FitReport& report,
                          Timer& timer, Progress& progress) {
  check_options(options);
  if (labels.tissue.size() != labels.grid.voxels())
    throw input_error("labels: ", labels.tissue.size(), " voxels on a grid of ",
                      labels.grid.voxels());
  Fit fit{labels, options, report, timer, progress, {}, {}, {}, {}, {}, {}};
  fit.geometry.side = labels.side;
  fit.geometry.skin_thickness = labels.skin_thickness;
  find_surface(fit);
  find_map(fit);
  find_skin_sheet(fit);
  find_wall_sheet(fit);
  find_rim(fit);
  find_thorax(fit);
  judge(fit);
  return std::move(fit.geometry);
}

}  // namespace breast
