// SPDX-License-Identifier: GPL-3.0-or-later
// A second scan of the same examination, which shows what the first does not.
#pragma once

#include "segment/work.hpp"
#include "surface/rigid_motion.hpp"

namespace breast {

/// Where the body of a second scan lies in the first.
struct SecondScan {
  RigidMotion motion;      ///< from the first scan to the second; none within one frame
  double residual_mm = 0;  ///< rms distance of the two skins in front of the sternum, with it
};

/// The two skins agree as they are if their distance is at most 4 mm rms; otherwise the rigid
/// motion with the least squares of distances is sought (Gauss-Newton, Tukey's weights). `body` and
/// `distance` (mm, negative inside) are those of the first, `mask` is the body of the second. Throws
/// Error (input) where they do not agree even then.
SecondScan align_skins(const TorsoFront& torso, const Volume<float>& distance, const Mask& mask);

/// Both on the voxels of the first that lie in the field of view of the second. `body` is that of
/// the first. Throws Error (input) if they hold less than half of it.
struct SharedField {
  Volume<float> first, second;
  double percent = 100;  ///< of the body in the first
};
SharedField shared_field(const Volume<float>& first, const Mask& body, const Volume<float>& second,
                         const RigidMotion& motion);

}  // namespace breast
