// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of the rib cages of two scans by their chest walls.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "image/label_volume.hpp"
#include "surface/rigid_motion.hpp"

namespace breast {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct WallAlignment {
  RigidMotion motion;  ///< from the first scan to the second, about the given centre
  Matrix6 covariance;  ///< covariance of shift (mm) and rotation (degrees), including the prior
  std::array<double, 6>
      from_walls{};  ///< share of the information about each component that comes from the walls
  double residual_mm = 0;  ///< rms distance of the walls at the compared places
  double left_out_percent =
      0;           ///< percentage of places left out as too far apart for the same surface
  int places = 0;  ///< number of compared places, 12 mm apart
  std::array<double, 3>
      laid_over{};  ///< initial shift of the second frame in mm; 0 if the frames differ by no more than a patient moves
  double deviation(int k) const { return std::sqrt(covariance(k, k)); }
  /// Sentences such as "shift along the body not determined by the walls: 2.3 mm, 1 % of it from
  /// them", one for each component of shift and rotation.
  std::vector<std::string> words() const;
};

/// The rigid motion that registers the first chest wall with the second, where a chest wall is the
/// front of the muscle in columns with a confidence above one half. The Gauss–Newton method with
/// Tukey's weights minimises distances along the normal of the first wall at places 12 mm apart,
/// with a prior of rms `shift_mm` and `turn_deg` in space. Frames that differ by more than 15 mm
/// are first shifted by midline and sternum, and the part of that shift along the body is then
/// uncertain by 30 mm. Distances are weighted by their own robust standard deviation, at least 1
/// mm, and are assumed to be correlated over 30 mm. Throws Error (input) if fewer than 20 places
/// can be compared, or if the walls do not agree within 4 mm rms.
WallAlignment align_walls(const LabelVolume& first, const LabelVolume& second, const Vec3& centre,
                          double shift_mm, double turn_deg);

}  // namespace breast
