// SPDX-License-Identifier: GPL-3.0-or-later
// How far the plates close in the next step.
#pragma once

#include <optional>
#include <vector>

#include "contact/path/target.hpp"

namespace breast {

/// Where a path may not pass without a stop; thicknesses in mm.
struct PathStops {
  std::optional<double> end;                ///< the path ends there at the latest
  std::vector<CompressionTarget> controls;  ///< targets that are not a thickness
  /// Where the load has a corner (PathOptions::corners): thicknesses, and values of the controls.
  std::vector<double> corners;
  std::vector<CompressionTarget> corner_controls = {};
};

/// Thickness (mm) at which the plates stop next, about `step` mm from the point `here`. The step is
/// shorter where it would pass a control, or the value of one at a corner, by much; it ends at a
/// corner's thickness or at the end if it would end just before or beyond it. `before` is the point
/// before `here`; null at the start of the path.
double next_thickness(double step, const PathPoint& here, const PathPoint* before,
                      const PathStops& stops);

/// The length of a step, mm, which adapts to the iterations that the positions take.
class StepLength {
 public:
  StepLength(double first, double shortest) : mm_(first), shortest_(shortest) {}
  double mm() const { return mm_; }
  /// Limits the length to the longest one allowed at the present position, mm.
  void limit(double longest) {
    longest_ = longest;
    mm_ = mm_ < longest ? mm_ : longest;
  }
  /// Whether a step of this length (mm) is abandoned if it begins badly, because a shorter one is
  /// likely to succeed at once.
  bool may_fail_fast(double length) const;
  /// Whether the next step should start from the last state itself: after two refusals in a row, the
  /// extrapolation may be the reason why elements fold.
  bool distrusts_extrapolation() const { return refusals_ % 3 == 2; }
  /// A position was solved in so many iterations.
  void adapt(int iterations);
  /// A step of this length (mm) failed. Returns false if half of it is shorter than the shortest.
  bool halve(double length);
  /// Begins anew with the longest step.
  void restart() {
    mm_ = longest_;
    refusals_ = 0;
  }

 private:
  double mm_, shortest_, longest_ = 0;
  int refusals_ = 0;  // since the last position that was solved
};

}  // namespace breast
