// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/skin_sheet.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace {

/// 1 inside the sheet, decreasing to a tenth at its border: data there are cropped irregularly and
/// are never part of the body.
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
  // Border points are held in both directions, because the sheet would otherwise shrink at its
  // edge.
  for (const int b : surface.border) data.tangential[b] = 1, data.fixed[b] = 1;
  data.trusted.assign(n, 0);
  const double areola = 20;  // mm
  for (std::size_t i = 0; i < n; ++i) {
    data.weights[i] *= surface.filled[i] ? 0 : border_weight(data.st[i]);
    data.trusted[i] = (data.points[i] - nipple).norm() < areola;
  }
  return data;
}

/// The requirements of the options on the sheet; `close_enough` refers to the largest distance.
FitControl control_of(const FitOptions& options,
                      std::function<bool(const HermiteSheet&, const SheetData&)> close_enough) {
  FitControl control;
  control.smoothing = options.smoothing;
  control.target_rms_mm = options.target_rms_mm;
  if (options.max_error_mm > 0) {  // then every point counts, outlier or not
    control.target_rms_mm = std::min(control.target_rms_mm, options.max_error_mm / 5);
    control.outlier_mm = 0;
  }
  control.close_enough = std::move(close_enough);
  return control;
}

}  // namespace

std::vector<std::pair<double, Vec3>> measured_points(
    const HermiteSheet& sheet, const SheetData& data, const DiscSurface& surface,
    const std::function<bool(const Vec2&)>& wanted) {
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

SkinSheet fit_skin(const DiscSurface& surface, const DiscMap& map, const Vec3& nipple,
                   const FitOptions& options, FitReport& report, Progress& progress) {
  const bool demanded = options.max_error_mm > 0;
  const double wanted = demanded ? options.max_error_mm : options.target_max_mm;
  const auto summary_of = [&](const HermiteSheet& sheet, const SheetData& at) {
    return summarise(distances_of(measured_points(sheet, at, surface, [&](const Vec2& st) {
      return within_margin(st, options.rays.margin);
    })));
  };
  const FitControl control =
      control_of(options, [&](const HermiteSheet& sheet, const SheetData& at) {
        return summary_of(sheet, at).max_mm <= wanted;
      });
  int patches_s = options.patches_s, patches_t = options.patches_t;
  const int most = demanded ? 40 : std::max({patches_s, patches_t, options.most_patches});
  SkinSheet best;
  for (;;) {
    SkinSheet now;
    now.data = sheet_data(surface, map, nipple);
    now.outcome = fit_sheet(patches_s, patches_t, now.data, control,
                            [](const HermiteSheet& sheet) { return !check_folds(sheet).folded(); });
    const Distances whole = summary_of(now.outcome.sheet, now.data);
    progress.update("skin sheet", 0.6,
                    message(patches_s, " x ", patches_t, ", rms ", now.outcome.rms_mm, " mm"));
    // A single place that no sheet reaches must not choose among them.
    if (best.outcome.loops == 0 || whole.max_mm <= wanted ||
        whole.p95_mm < report.whole_skin_to_sheet.p95_mm) {
      best = std::move(now);
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
                              "; choose a larger value");
  }
}

}  // namespace breast
