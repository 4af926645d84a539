// SPDX-License-Identifier: GPL-3.0-or-later
// Targets at which a compression stops, and how far a state of its path is from them.
#pragma once

#include <optional>
#include <vector>

namespace breast {

enum class TargetKind { thickness, force, pressure, area };

/// Target: thickness between the flat parts of the plates (mm), paddle force (N), paddle force per
/// contact area (kPa), or the paddle's contact area (cm²).
struct CompressionTarget {
  TargetKind kind = TargetKind::thickness;
  double value = 0;
  /// Further places to stop: the path ends at the first of all that it reaches.
  std::vector<CompressionTarget> or_at = {};
};

/// A converged state of the path.
struct PathPoint {
  double thickness = 0;  ///< mm
  double paddle_N = 0, detector_N = 0, pressure_kPa = 0, area_cm2 = 0;
  int iterations = 0;
};

/// "thickness", "paddle force", "mean pressure" or "contact area".
const char* target_name(TargetKind kind);
/// The quantity of a target at a point of the path, in the target's unit.
double measure(const PathPoint& point, TargetKind kind);

enum class StopAt { thickness, reduction, force, pressure, area };

/// A target as it is asked for: mm, %, N, kPa or cm².
struct CompressionStop {
  StopAt at = StopAt::reduction;
  double value = 50;
};
/// The target of a stop for plates that begin `initial` mm apart.
CompressionTarget target_of(const CompressionStop& stop, double initial);
/// The largest thickness among a target and its alternatives; nothing without any.
std::optional<double> thickness_in(const CompressionTarget& target);
/// Those of a target and its alternatives that are none of thickness.
std::vector<CompressionTarget> others_than_thickness(const CompressionTarget& target);
/// Fraction of the way to the nearest of the target and its alternatives, for plates that began
/// `initial` mm apart.
double part_of_way(const PathPoint& end, const CompressionTarget& target, double initial);

}  // namespace breast
