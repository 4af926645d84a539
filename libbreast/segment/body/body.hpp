// SPDX-License-Identifier: GPL-3.0-or-later
// The body against air, and the frame of the torso: skin depth, midline, cleft.
#pragma once

#include <limits>

#include "core/types.hpp"
#include "core/units.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {

/// Value of a column without the surface, or without the thickness measured from it: not a number.
inline constexpr double no_depth = std::numeric_limits<double>::quiet_NaN();

/// Depth (mm along j from the grid's first voxel centre) per column (i,k), or no_depth.
struct HeightField {
  int nx = 0, nz = 0;
  std::vector<double> depth;
  HeightField() = default;
  HeightField(int x, int z, double value) : nx(x), nz(z), depth(std::size_t(x) * z, value) {}
  double& at(int i, int k) { return depth[std::size_t(k) * nx + i]; }
  double at(int i, int k) const { return depth[std::size_t(k) * nx + i]; }
};

struct Body {
  Mask mask;             ///< body with lungs and other cavities filled
  double air_level = 0;  ///< n0: 90th percentile of the air in front of the patient
  double threshold = 0;  ///< intensity that separates body from air
  double debris_ml = 0;  ///< removed from the skin: markers and similar objects
  double beside_ml = 0;  ///< tissue separate from the torso that was omitted, such as arms
};
/// Otsu's threshold on log(I + n0), opening, largest component, closing, filling. Throws Error
/// (input) if there is no contrast or no air in front. `side` is the requested breast, which
/// matters if the field of view shows only one. Debris on the skin is not removed from a supine
/// body, because the position of the nipples does not distinguish them from it.
Body find_body(const Volume<float>& scan, Side side, Posture posture = Posture::prone);

struct TorsoFront {
  HeightField skin;           ///< first body voxel from the front
  int midline = 0;            ///< column i of the sternum
  std::vector<double> cleft;  ///< depth (mm) of the skin over the sternum, per slice; above its
                              ///< notch that of the chest, not of the neck
  bool one_breast = false;    ///< true if the other breast is not in the field of view
};
/// The midline is the mirror column of the skin. If only one breast is in view (less than 270 mm of
/// body and no valley between two), it is the deepest column medial to the breast of `side`.
TorsoFront find_torso(const Mask& body, Side side);
/// Angle (radians) about the long axis of the body by which the grid is rotated relative to the
/// body's mirror plane; 0 if a rotation does not explain the skin's asymmetry better, or if only
/// one breast is in view.
double body_roll(const Mask& body);

}  // namespace breast
