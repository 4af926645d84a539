// SPDX-License-Identifier: GPL-3.0-or-later
// Least-squares fit of a Hermite sheet to points, smoothed by a penalty on its second derivatives.
#pragma once

#include <functional>
#include <vector>

#include "core/types.hpp"
#include "surface/hermite.hpp"

namespace breast {

/// Data points for a sheet, each with a parameter.
struct SheetData {
  std::vector<Vec3> points;     ///< mm
  std::vector<Vec3> normals;    ///< unit: the direction whose residual counts fully
  std::vector<double> weights;  ///< >= 0
  std::vector<double>
      tangential;        ///< weight of the residual across the normal, relative: 0.1; 1 at a border
  std::vector<Vec2> st;  ///< parameter of each point
  std::vector<char> trusted;  ///< 1: never an outlier (near the nipple); may be empty
  std::vector<char> fixed;    ///< 1: the parameter is never moved
};

/// Minimises  sum w [(n.r)^2 + b |r - (n.r) n|^2] / sum w  +  smoothing * int |x_ss|^2 + 2|x_st|^2
/// + |x_tt|^2 over all degrees of freedom of an nu x nv sheet; r = x(s,t) - point (mm), the
/// integral over [0,1]^2. Throws Error (failed) when the system is singular.
HermiteSheet solve_sheet(int nu, int nv, const SheetData& data, double smoothing);

/// Moves every free parameter to the closest point on the sheet (local search) and stores the
/// sheet's normal there. Returns the weighted root mean square of the free points' distances, mm.
double project(const HermiteSheet& sheet, SheetData& data);

struct FitControl {
  double smoothing = 0;  ///< > 0: this one; 0: start at 1e-6 and quarter it until target_rms
  double target_rms_mm = 0.3;
  double least_smoothing = 1e-9;
  /// May be empty: smoothing is also lowered until this holds, after target_rms.
  std::function<bool(const HermiteSheet&, const SheetData&)> close_enough;
  /// Points farther off than this (or 4 rms) lose weight (Cauchy): marks and debris on the skin do
  /// not dent the sheet. 0: none do.
  double outlier_mm = 2;
  int settle = 3;  ///< projections at the final smoothing
};

struct FitOutcome {
  HermiteSheet sheet;
  double smoothing = 0;
  double rms_mm = 0;
  int loops = 0;
  bool reached = false;  ///< target_rms_mm was met
};

/// Alternates solve_sheet and project. `acceptable(sheet)` can reject a sheet (because of folds):
/// the last acceptable one is then returned, and smoothing is not lowered further. Throws Error
/// (not_converged) if none was acceptable.
FitOutcome fit_sheet(int nu, int nv, SheetData& data, const FitControl& control,
                     const std::function<bool(const HermiteSheet&)>& acceptable);

/// Folding of a sheet: smallest cosine between normals of neighbouring samples, and smallest ratio
/// of its area element |x_s × x_t| to the median, over `per_patch` samples per side.
struct FoldCheck {
  double min_cosine = 1, min_area_ratio = 1;
  bool folded() const { return !(min_cosine > 0) || !(min_area_ratio > 0.005); }
};
FoldCheck check_folds(const HermiteSheet& sheet, int per_patch = 8);

}  // namespace breast
