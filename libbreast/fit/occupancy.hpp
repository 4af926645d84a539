// SPDX-License-Identifier: GPL-3.0-or-later
// The body, or its muscle, as a smooth occupancy field in a box around one breast: 1 inside, 0
// outside, its surface at 1/2.
#pragma once

#include <functional>

#include "core/types.hpp"
#include "image/label_volume.hpp"
#include "image/volume.hpp"

namespace breast {

/// Axis-aligned box in LPS, mm.
struct Box {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};

/// Location of the breast in a label volume, and the part of the body that its sheets must cover.
struct BreastRegion {
  Box foot;     ///< box of the breast's own voxels
  Box crop;     ///< foot box and margin, clipped to the field of view and just past the midline
  Vec3 nipple;  ///< landmark, or the most anterior breast voxel
  bool nipple_known = false;
  double breast_ml = 0;  ///< volume of the breast's voxels
};

/// Throws Error (input) when there is no breast, or the field of view leaves nothing to fit.
BreastRegion find_region(const LabelVolume& labels, double margin_mm);

/// Largest axis-aligned box inside the (possibly tilted) field of view.
Box field_of_view(const Grid& grid);

/// Gaussian-smoothed occupancy of some tissues on the voxels around a box, with interpolated slices
/// if they are thick.
class OccupancyField {
 public:
  /// `smoothing_mm` is the Gaussian's sigma, at least 0.6 voxels along every axis.
  OccupancyField(const LabelVolume& labels, const Box& box, double smoothing_mm,
                 const std::function<bool(Tissue)>& counts);
  /// Trilinear interpolation; values at the border of the field of view are extended outwards,
  /// except that there is nothing in front of it.
  double value(const Vec3& p) const;
  Vec3 gradient(const Vec3& p) const;      ///< per mm, central differences of half the smoothing
  double front() const { return front_; }  ///< y of the field of view's anterior end

 private:
  Volume<float> occupancy_;
  double smoothing_ = 0;
  double front_ = 0;  ///< y of the field of view's anterior end
};

}  // namespace breast
