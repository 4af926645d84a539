// SPDX-License-Identifier: GPL-3.0-or-later
// The chest wall as a height field over (x,z): region-cost minimum cut, then snapping to the
// half-height crossing.
#pragma once

#include <optional>

#include "segment/body/body.hpp"

namespace breast {

/// The wall is sought to this depth (mm) behind the skin over the sternum, deeper by half of what a column lies farther
/// aside than where the chest begins to curve back (mm from the midline).
inline constexpr double sought_behind = 60, curving_back = 90;

/// Columns in which the wall is sought, and the range of its depth.
struct WallDomain {
  int first = 0, last = 0;      ///< columns i, inclusive
  std::vector<double> nearest;  ///< smallest depth of the wall, mm, per slice
  HeightField deepest;          ///< largest depth of the wall, mm, per column
  HeightField skin;             ///< skin in front of the wall, mm; NaN outside the body
  bool left = true;             ///< the left breast: its medial end is the first column

  /// Column `n` from the medial end, and back. Counted from there, a mirror image has the same
  /// columns.
  int from_medial(int n) const { return left ? first + n : last - n; }
  int to_medial(int i) const { return left ? i - first : last - i; }
};
/// `seen` marks the voxels that have data (empty: all): no wall is sought behind the last of them.
WallDomain wall_domain(const Mask& body, const TorsoFront& torso, bool left, const Mask& seen);

struct ChestWall {
  /// Depth of the wall, mm, on columns of the domain (all i; NaN outside [first,last]).
  HeightField depth;
  HeightField confidence;   ///< (fat index in front − fat index behind) / 0.6, clipped to [0,1]
  HeightField sigma;        ///< standard deviation of the depth, mm (wall_uncertainty.hpp)
  double muscle_ratio = 0;  ///< brightness of muscle relative to fat
};

/// Finds the wall. `ratio` is intensity / bias. `start` is the surface of an earlier pass, for its
/// muscle ratio and prior.
ChestWall find_chest_wall(const Volume<float>& ratio, const WallDomain& domain,
                          const ChestWall* start);
/// Moves the wall to the nearest bright-to-dark crossing of (1 + muscle)/2 within 3 mm and smooths.
void snap_chest_wall(ChestWall& wall, const Volume<float>& ratio, const WallDomain& domain);

}  // namespace breast
