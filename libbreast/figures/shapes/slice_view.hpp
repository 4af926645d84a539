// SPDX-License-Identifier: GPL-3.0-or-later
// A slice of a scan in one of the three planes, with the contours of its segmentation.
#pragma once

#include <vector>

#include "figures/shapes/contour_lines.hpp"
#include "image/label_volume.hpp"
#include "image/volume.hpp"

namespace breast {

enum class SlicePlane { axial, sagittal, coronal };

/// A rectangle of the plane through a point, in mm in the patient frame. Axial slices are seen from
/// below with anterior on top, sagittal ones from the patient's left with anterior on the left, and
/// coronal ones from the front.
struct SliceFrame {
  SlicePlane plane = SlicePlane::axial;
  Vec3 right, up, corner;        ///< unit vectors, and the lower left corner
  double width = 0, height = 0;  ///< mm

  /// The frame of `size` mm around a point.
  SliceFrame(SlicePlane plane, const Vec3& centre, const Vec2& size);
  Vec3 at(const Vec2& mm) const { return corner + mm.x() * right + mm.y() * up; }
  Vec2 flat(const Vec3& x) const { return {(x - corner).dot(right), (x - corner).dot(up)}; }
  double distance(const Vec3& x) const;  ///< distance from the plane, mm
};

/// Contours as segments, in mm in the frame.
struct SliceContours {
  /// Border of the body towards air, where it belongs to the breast.
  std::vector<PlaneSegment> skin;
  std::vector<PlaneSegment> wall;   ///< chest wall where the breast lies on it
  std::vector<PlaneSegment> gland;  ///< contour of a fibroglandular fraction of one half
};
SliceContours slice_contours(const LabelVolume& labels, const SliceFrame& frame);

/// The part of the scan to be shown: the labelled breast with `margin` mm around it. Throws Error
/// (input) if the labels contain no breast.
struct ShownBox {
  Vec3 low, high;
  Vec3 centre() const { return 0.5 * (low + high); }
};
/// Throws Error (input) when the labels hold no breast.
ShownBox breast_box(const LabelVolume& labels, double margin);
/// Mean position of the fibroglandular tissue, or of the breast if there is none.
Vec3 breast_centre(const LabelVolume& labels);

/// The intensity shown as white: the 99.5th percentile of the breast's voxels.
double white_level(const Volume<float>& scan, const LabelVolume& labels);
/// 16-bit grey values in rows from the top, one value every `pixel` mm; black outside the scan.
struct SliceImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> grey;
};
SliceImage slice_image(const Volume<float>& scan, const SliceFrame& frame, double pixel,
                       double white);

}  // namespace breast
