#include "fit/fit_breast.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fit/closest_point.hpp"
#include "fit/disc_map.hpp"
#include "fit/disc_surface.hpp"
#include "fit/rim_volume.hpp"
#include "fit/sheet_fit.hpp"

namespace breast {

namespace {

/// Where the body touches the anterior end of the field of view its skin was not imaged.
void check_front(const DiscSurface& surface, double front, FitReport& report) {
  double cut = 0, total = 0;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    total += surface.areas[i];
    if (surface.points[i].y() < front + 1.5) cut += surface.areas[i];
  }
  const double percent = 100 * cut / total;
  if (percent > 10)
    throw input_error("labels: the body touches the front end of the field of view over ", percent,
                      " % of its skin; at most 10 % can be bridged; the scan or the crop cuts the "
                      "breast off");
  if (percent > 0.1)
    report.doubts.push_back(message("the front end of the field of view cuts off ", percent,
                                    " % of the skin: it is flat there"));
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
        report.doubts.push_back(message("the skin was smoothed by ", smoothing, " mm and cropped ",
                                        part * options.margin_mm,
                                        " mm beyond the breast to become a disc: ", reason));
      return surface;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::input) throw;
      if (reason.empty()) reason = error.what();
    }
  }
  throw Error(ErrorKind::input, reason);
}

/// 1 inside the sheet, falling to a tenth at its border: what lies there is cropped raggedly and
/// never part of the body.
double border_weight(const Vec2& st) {
  const double distance = std::min(st.minCoeff(), 1 - st.maxCoeff());
  const double x = std::clamp(distance / 0.04, 0.0, 1.0);
  return 0.1 + 0.9 * x * x * (3 - 2 * x);
}

SheetData sheet_data(const DiscSurface& surface, const DiscMap& map, const Vec3& nipple) {
  SheetData data;
  const std::size_t n = surface.points.size();
  data.points = surface.points;
  data.normals = surface.normals;
  data.st = map.st;
  data.weights = surface.areas;
  data.tangential.assign(n, 0.1);
  data.fixed.assign(n, 0);
  // Border points hold their place in both directions, else the sheet shrinks at its edge.
  for (const int b : surface.border) data.tangential[b] = 1, data.fixed[b] = 1;
  data.trusted.assign(n, 0);
  const double areola = 20;  // mm
  for (std::size_t i = 0; i < n; ++i) {
    data.weights[i] *= surface.filled[i] ? 0 : border_weight(data.st[i]);
    data.trusted[i] = (data.points[i] - nipple).norm() < areola;
  }
  return data;
}

using Wanted = std::function<bool(const Vec2&)>;

/// Data points that say how good the sheet is, and their distances to it, mm.
std::vector<std::pair<double, Vec3>> measured_points(const HermiteSheet& sheet,
                                                     const SheetData& data,
                                                     const DiscSurface& surface,
                                                     const Wanted& wanted) {
  std::vector<std::pair<double, Vec3>> measured;
  for (std::size_t i = 0; i < data.points.size(); ++i)
    if (!data.fixed[i] && !surface.filled[i] && wanted(data.st[i]))
      measured.emplace_back((sheet.position(data.st[i]) - data.points[i]).norm(), data.points[i]);
  return measured;
}

std::vector<double> distances_of(const std::vector<std::pair<double, Vec3>>& measured) {
  std::vector<double> distances;
  for (const auto& [distance, point] : measured) distances.push_back(distance);
  return distances;
}

/// Fits the skin sheet; refines it by a quarter more patches at a time until max_error_mm, which
/// must be met, or target_max_mm, which should be.
FitOutcome fit_skin(const DiscSurface& surface, const DiscMap& map, const Vec3& nipple,
                    const FitOptions& options, FitReport& report, SheetData& data,
                    Progress& progress) {
  const bool demanded = options.max_error_mm > 0;
  const double wanted = demanded ? options.max_error_mm : options.target_max_mm;
  const auto summary_of = [&](const HermiteSheet& sheet, const SheetData& at) {
    return summarise(distances_of(measured_points(
        sheet, at, surface, [&](const Vec2& st) { return within_margin(st, options.rim); })));
  };
  FitControl control;
  control.smoothing = options.smoothing;
  control.target_rms_mm = options.target_rms_mm;
  if (demanded) {  // then every point counts, outlier or not
    control.target_rms_mm = std::min(control.target_rms_mm, options.max_error_mm / 5);
    control.outlier_mm = 0;
  }
  control.close_enough = [&](const HermiteSheet& sheet, const SheetData& at) {
    return summary_of(sheet, at).max_mm <= wanted;
  };
  int patches_s = options.patches_s, patches_t = options.patches_t;
  const int most = demanded ? 40 : std::max({patches_s, patches_t, options.most_patches});
  FitOutcome best;
  for (;;) {
    SheetData used = sheet_data(surface, map, nipple);
    FitOutcome outcome =
        fit_sheet(patches_s, patches_t, used, control,
                  [](const HermiteSheet& sheet) { return !check_folds(sheet).folded(); });
    const DistanceSummary whole = summary_of(outcome.sheet, used);
    progress.update("skin sheet", 0.6,
                    message(patches_s, " x ", patches_t, ", rms ", outcome.rms_mm, " mm"));
    if (best.loops == 0 || whole.max_mm < report.whole_skin_to_sheet.max_mm) {
      best = std::move(outcome);
      data = std::move(used);
      report.whole_skin_to_sheet = whole;
      report.patches_s = patches_s;
      report.patches_t = patches_t;
    }
    if (whole.max_mm <= wanted) return best;
    patches_s += std::max(1, patches_s / 4);
    patches_t += std::max(1, patches_t / 4);
    if (patches_s <= most && patches_t <= most) continue;
    if (!demanded) return best;
    throw not_converged_error("skin sheet: largest distance ", report.whole_skin_to_sheet.max_mm,
                              " mm with ", report.patches_s, " x ", report.patches_t,
                              " patches, above --max-error ", options.max_error_mm,
                              "; ask for less");
  }
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
  report.sheet_to_skin =
      summarise(distances_to_triangles(surface.points, surface.triangles, samples));
}

void find_doubts(const BreastRegion& region, const BreastGeometry& geometry, FitReport& report) {
  const auto doubt = [&](const auto&... parts) { report.doubts.push_back(message(parts...)); };
  if (!report.target_reached)
    doubt("the skin's rms distance is ", report.rms_mm,
          " mm, above the target; more --elements help");
  if (report.skin_to_sheet.max_mm > 2)
    doubt("the skin's largest distance to its sheet is ", report.skin_to_sheet.max_mm, " mm");
  if (!region.nipple_known)
    doubt("no nipple landmark in the labels: the most anterior point stands in for it");
  if (report.nipple_moved_mm > 5)
    doubt("the nipple landmark lies ", report.nipple_moved_mm, " mm off the skin sheet");
  if (report.wall_coverage < 0.9)
    doubt("the chest wall is seen behind ", 100 * report.wall_coverage, " % of the breast only");
  if (report.filled_points > 0)
    doubt("the skin leaves the field of view inside the breast's outline: ", report.filled_points,
          " hole(s) bridged by the smooth sheet");
  const double margin =
      double(std::count(geometry.rim_end.begin(), geometry.rim_end.end(), RimEnd::margin)) /
      double(geometry.rim_end.size());
  if (margin > 0.1)
    doubt(std::lround(100 * margin),
          " % of the rim lies where the sheet ends, not where the breast does "
          "(field of view, midline, or tissue that never thins)");
  if (!(std::abs(report.body_ml / report.label_ml - 1) < 0.01))
    doubt("the body inside the rim has ", std::lround(report.body_ml), " ml, the labelled breast ",
          std::lround(report.label_ml), " ml: the rim cannot follow where the labels end");
  if (report.rim.skin_angle_min < 30 || report.rim.wall_angle_min < 30)
    doubt("sharp rim: ", std::lround(report.rim.skin_angle_min), " degrees at the skin, ",
          std::lround(report.rim.wall_angle_min), " at the wall");
  if (report.rim.skin_angle_max > 160 || report.rim.wall_angle_max > 160)
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
  check(options.rim.rays, 32, 1024, "rim rays");
  check(options.rim.margin, 0.01, 0.3, "rim margin");
}

}  // namespace

BreastGeometry fit_breast(const LabelVolume& labels, const FitOptions& options, FitReport& report,
                          Timer& timer, Progress& progress) {
  check_options(options);
  if (labels.tissue.size() != labels.grid.voxels())
    throw input_error("labels: ", labels.tissue.size(), " voxels on a grid of ",
                      labels.grid.voxels());
  BreastRegion region;
  DiscSurface surface;
  {
    Timer::Scope phase(timer, "skin surface");
    progress.update("skin surface", 0, "");
    surface = skin_surface(labels, region, options, report);
    report.data_points = surface.points.size();
    report.filled_points =
        std::size_t(std::count(surface.filled.begin(), surface.filled.end(), char(1)));
    report.label_ml = region.breast_ml;
  }
  DiscMap map;
  {
    Timer::Scope phase(timer, "map to square");
    progress.update("map to square", 0.2, message(surface.points.size(), " points"));
    map = map_to_square(surface);
    report.area_ratio_p95 = map.area_ratio_p95;
  }
  BreastGeometry geometry;
  geometry.side = labels.side;
  geometry.skin_thickness = labels.skin_thickness;
  SheetData data;
  {
    Timer::Scope phase(timer, "skin sheet");
    FitOutcome outcome = fit_skin(surface, map, region.nipple, options, report, data, progress);
    geometry.skin = std::move(outcome.sheet);
    report.smoothing = outcome.smoothing;
    report.rms_mm = outcome.rms_mm;
    report.loops = outcome.loops;
    report.target_reached = outcome.reached || options.smoothing > 0;
    const FoldCheck folds = check_folds(geometry.skin);
    report.min_normal_cosine = folds.min_cosine;
    report.min_area_ratio = folds.min_area_ratio;
  }
  WallSheet wall;
  {
    Timer::Scope phase(timer, "wall sheet");
    progress.update("wall sheet", 0.7, "");
    wall =
        fit_wall(labels, region, options.patches_s, options.patches_t, options.wall_smoothing_mm);
    geometry.wall = wall.sheet;
    report.wall_rms_mm = wall.rms_mm;
    report.wall_p95_mm = wall.residual_p95_mm;
    report.wall_coverage = wall.coverage;
  }
  {
    Timer::Scope phase(timer, "rim");
    progress.update("rim", 0.85, "");
    const SheetFoot nipple = SheetLocator(geometry.skin, 4).closest(region.nipple);
    geometry.nipple_st = nipple.st;
    geometry.nipple = nipple.x;
    report.nipple_moved_mm = region.nipple_known ? nipple.distance : 0;
    const RimRays rays =
        walk_rim(geometry.skin, wall, labels.side, geometry.nipple_st, options.rim);
    report.rim = rim_of_volume(region.breast_ml, wall, rays, options.rim, geometry);
  }
  Timer::Scope phase(timer, "distances");
  progress.update("distances", 0.95, "");
  measure_fit(surface, data, geometry, report);
  report.body_ml = enclosed_volume(geometry) * 1e-3;
  geometry.fit_mean_mm = report.skin_to_sheet.mean_mm;
  geometry.fit_p95_mm = report.skin_to_sheet.p95_mm;
  geometry.fit_max_mm = report.skin_to_sheet.max_mm;
  find_doubts(region, geometry, report);
  return geometry;
}

}  // namespace breast
