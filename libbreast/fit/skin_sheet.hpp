// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of the skin's Hermite sheet, with as many patches as the bound on the largest distance
// requires.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "core/progress.hpp"
#include "fit/disc_map.hpp"
#include "fit/disc_surface.hpp"
#include "fit/fit_breast.hpp"
#include "fit/sheet_fit.hpp"

namespace breast {

struct SkinSheet {
  FitOutcome outcome;
  SheetData data;  ///< the skin's points, each with its closest point on the sheet
};

/// Fits the skin sheet; refines it by a quarter more patches at a time until max_error_mm, which
/// must be met, or target_max_mm, which should be. Writes patches and whole_skin_to_sheet into the
/// report. Throws Error (not_converged) where max_error_mm is not met or every sheet folds.
SkinSheet fit_skin(const DiscSurface& surface, const DiscMap& map, const Vec3& nipple,
                   const FitOptions& options, FitReport& report, Progress& progress);

/// The points by which the quality of a sheet is measured (imaged skin whose parameter is in
/// `wanted`), and their distances to it, mm.
std::vector<std::pair<double, Vec3>> measured_points(
    const HermiteSheet& sheet, const SheetData& data, const DiscSurface& surface,
    const std::function<bool(const Vec2&)>& wanted);
std::vector<double> distances_of(const std::vector<std::pair<double, Vec3>>& measured);

}  // namespace breast
