// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of tissue from the scanned to another posture, in the quantities measured on women: along
// the body's axes, and towards the ribs by depth.
#pragma once

#include <string>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Tissue between two distances from the rib cage in the scan, mm.
struct DepthBin {
  double low = 0, high = 0;
  double fraction = 0;  ///< of the breast's volume
  double moved = 0;     ///< mean distance moved, mm
  double change = 0;    ///< mean change of the distance to the ribs, mm
};

struct PostureMotion {
  /// Displacement of the nipple, mm: lateral, posterior and caudal.
  double nipple_lateral = 0, nipple_posterior = 0, nipple_caudal = 0, nipple_moved = 0;
  /// Twice the nipple's distance from the midline (the axis of the wall surface), mm.
  double nipples_apart_before = 0, nipples_apart_after = 0;
  /// Distance of the nipple in front of the sternal notch, mm, which is taken as the point of the
  /// wall surface on the midline, notch_height_mm above the imaged nipple.
  double before_notch_before = 0, before_notch_after = 0;
  double ribs_before = 0, ribs_after = 0;  ///< mean distance of tissue from the ribs, mm
  /// Median of the ratio of the distance after to that before.
  double ratio = 0;
  std::vector<DepthBin> bins;  ///< 0 to 20, 20 to 40, above 40 mm
  /// Change of the distance from the ribs, mm, of tissue that lies far_landmark_mm from them in the scan: by
  /// linear regression over the tissue of the last range. Breasts of different protrusion compare in it.
  double far_change = 0;
  double nearest_moved = 0;  ///< mean motion of tissue within 20 mm of the wall
};

/// A value of one breast, named as in a table of women's (pipelines/invivo/women.tsv). In a mean over breasts,
/// a range of depths counts by the fraction of the breast that lies in it, since as many of a woman's landmarks
/// do.
struct MotionQuantity {
  std::string name;
  double value = 0, weight = 1;
};
std::vector<MotionQuantity> motion_quantities(const PostureMotion& motion);

/// Distance along the body from the nipple to the sternal notch in the scan, which is assumed
/// because scans of breasts end below the notch.
inline constexpr double notch_height_mm = 140;

/// Mean distance of women's landmarks above 40 mm from the ribs when prone.
inline constexpr double far_landmark_mm = 71;

/// The motion from mesh.imaged to mesh.points, with elements weighted by their volume in the scan.
/// The ribs are assumed to lie `muscle_mm` behind the mesh's wall surface. Throws Error (input)
/// without a wall surface or a nipple.
PostureMotion posture_motion(const HexMesh& mesh, double muscle_mm);

/// Distance (mm) of a place from the surface, negative inside; the closest point is found by
/// alternating moves onto the surface and along it.
double wall_surface_distance(const ThoraxSurface& surface, const Vec3& x);

}  // namespace breast
