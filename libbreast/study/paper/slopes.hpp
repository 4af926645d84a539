// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes d ln u / d ln s of the displacement u with respect to the stiffness s, from one
// tangent-linear solve and from solving again.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "core/table.hpp"
#include "core/types.hpp"

namespace breast {

/// Derivative at 0 of the parabola through (0, f0), (a, fa), (b, fb).
template <class Value>
Value parabola_slope(double a, double b, const Value& f0, const Value& fa, const Value& fb) {
  return (fa - f0) * (b / (a * (b - a))) - (fb - f0) * (a / (b * (b - a)));
}

/// d ln u / d ln s between two rows with stiffness `low` and `high` in per cent; both displacements
/// must be positive.
double slope_between(double low, double u_low, double high, double u_high);

/// The positions of one landmark in mm, at 100 per cent and at four stiffnesses s = percent / 100,
/// the two near ones first.
struct ResolvedPlaces {
  Vec3 imaged{0, 0, 0}, base{0, 0, 0};
  std::array<double, 4> stiffness{};
  std::array<Vec3, 4> places{};
};
struct TangentSlope {
  double slope = 0;          ///< d ln u / d ln s
  Vec3 derivative{0, 0, 0};  ///< derivative of the landmark's position with respect to ln s, mm
};
struct SlopeComparison {
  double resolved = 0;    ///< three-point derivative through the near steps
  double difference = 0;  ///< tangent minus resolved
  /// Error of the near steps, from the same formula with the far steps and the orders of both.
  double step_error = 0;
  double vector_percent =
      0;  ///< distance of both derivatives of the place, per cent of the resolved one's length
  bool agrees = false;  ///< difference at most twice step_error plus 1e-4
};
SlopeComparison compare_slopes(const TangentSlope& tangent, const ResolvedPlaces& resolved);

/// Table VII: every slope in the tables of `sensitivity`, compared with Tables III to VI solved
/// again. `base` is the supine report of the 100 per cent state, `scaled` the folder of the
/// variants TISSUE-PERCENT. The steps are 90, 110 and 50, 200 per cent; for the tumour they are
/// 150, 200 and 200, 500, one-sided. "not evaluated" if any of these has no solution.
Table slopes_table(const std::filesystem::path& base, const std::filesystem::path& scaled,
                   const Table& slopes, const Table& tumour_slopes);

}  // namespace breast
