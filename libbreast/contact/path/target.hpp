// SPDX-License-Identifier: GPL-3.0-or-later
// Targets at which a compression stops, and the distance of a state on its path from them.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace breast {

enum class TargetKind { thickness, force, pressure, area };

/// A target: thickness between the flat parts of the plates (mm), paddle force (N), paddle force
/// per contact area (kPa), or contact area of the paddle (cm²).
struct CompressionTarget {
  TargetKind kind = TargetKind::thickness;
  double value = 0;
  /// Further targets: the path ends at the first one that it reaches.
  std::vector<CompressionTarget> or_at = {};
  /// A mean pressure is that over at least this area, cm²: over the first points that touch, any
  /// force is a large pressure.
  double least_area_cm2 = 0;
};

/// A converged state of the path.
struct PathPoint {
  double thickness = 0;  ///< mm
  double paddle_N = 0, detector_N = 0, pressure_kPa = 0, area_cm2 = 0;
  double paddle_edge_N = 0, detector_edge_N = 0;  ///< of the force, that on the rounded edge
  int iterations = 0;
};

/// The parts of the paddle's and the detector's force that lie on their rounded edges.
std::array<double, 2> edge_parts(const PathPoint& point);
/// The larger of the two.
double largest_edge_part(const PathPoint& point);
/// "thickness", "paddle force", "mean pressure" or "contact area".
const char* target_name(TargetKind kind);
/// The quantity of a target at a point of the path, in the target's unit.
double measure(const PathPoint& point, const CompressionTarget& target);

enum class StopAt { thickness, reduction, force, pressure, area };

/// A target as given by the user, in mm, %, N, kPa or cm².
struct CompressionStop {
  StopAt at = StopAt::reduction;
  double value = 50;
};
/// The target that corresponds to a stop for plates with an initial distance of `initial` mm.
CompressionTarget target_of(const CompressionStop& stop, double initial);
/// The largest thickness among a target and its alternatives; nothing without any.
std::optional<double> thickness_in(const CompressionTarget& target);
/// Those of a target and its alternatives that are none of thickness.
std::vector<CompressionTarget> others_than_thickness(const CompressionTarget& target);
/// Parts of the way closer than this are the same: they follow from a thickness, with rounding.
inline constexpr double same_part = 1e-9;
/// Part of the way (0 to 1) to the nearest of the target and its alternatives at a point `end`, for
/// plates that began `initial` mm apart. Of a thickness that is an alternative to a force, a pressure or an area, the way is
/// the cube of the part of the closing: soft breasts are half closed before the plates grip them, and a hand that let go by
/// then would lose what it has pulled forwards.
double part_of_way(const PathPoint& end, const CompressionTarget& target, double initial);
/// The part of the closing to a thickness of the target that is this part of the way.
double closing_at(double way, const CompressionTarget& target);
/// part_of_way of a point at a thickness (mm) that is not known yet: forces, pressures and areas continue
/// as from `before` to `here`, or stay as they are if `before` is null.
double expected_part_of_way(double thickness, const PathPoint& here, const PathPoint* before,
                            const CompressionTarget& target, double initial);

}  // namespace breast
