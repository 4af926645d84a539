// SPDX-License-Identifier: GPL-3.0-or-later
// How a rib cage lies in a second scan against the first, from the chest walls of both.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "surface/rigid_motion.hpp"
#include "image/label_volume.hpp"

namespace breast {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct WallAlignment {
  RigidMotion motion;  ///< from the first scan to the second, about the centre asked for
  Matrix6 covariance;  ///< of shift (mm) and turn (degrees), the prior included
  std::array<double, 6> from_walls{};  ///< share of what is known of each that the walls tell
  double residual_mm = 0;              ///< rms distance of the walls where they were compared
  double left_out_percent = 0;  ///< of the places compared: farther than is likely for one surface
  int places = 0;               ///< 12 mm apart
  std::array<double, 3>
      laid_over{};  ///< mm, of which the scans' frames differ by more than a patient moves
  double deviation(int k) const { return std::sqrt(covariance(k, k)); }
  /// "shift along the body not determined by the walls: 2.3 mm, 1 % of it from them", one each for shift and turn
  std::vector<std::string> words() const;
};

/// The rigid motion that lays the first wall (where muscle begins, on columns whose confidence is above a half) over the
/// second: Gauss and Newton's method on distances along the first wall's normal at places 12 mm apart, with Tukey's
/// weights, about a prior of rms `shift_mm` and `turn_deg` in space (of a shift of the frames by more than 15 mm, taken from midline
/// and sternum, the part along the body is known to 30 mm only). Distances count with their own robust deviation, at least 1 mm,
/// and hang together over 30 mm. Throws Error (input) when fewer than 20 places lie over each other, or they do not fit within 4 mm rms.
WallAlignment align_walls(const LabelVolume& first, const LabelVolume& second, const Vec3& centre,
                          double shift_mm, double turn_deg);

}  // namespace breast
