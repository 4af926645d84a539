// SPDX-License-Identifier: GPL-3.0-or-later
// A scan's slice in one of the three planes, with the contours of its segmentation.
#pragma once

#include <vector>

#include "figures/shapes/contour_lines.hpp"
#include "image/label_volume.hpp"
#include "image/volume.hpp"

namespace breast {

enum class SlicePlane { axial, sagittal, coronal };

/// A rectangle of the plane through a point, mm in the patient frame. Axial slices are seen from below with
/// anterior on top, sagittal ones from the patient's left with anterior on the left, coronal ones from
/// the front.
struct SliceFrame {
  SlicePlane plane = SlicePlane::axial;
  Vec3 right, up, corner;        ///< unit vectors; the lower left corner
  double width = 0, height = 0;  ///< mm

  /// The frame of `size` mm about a point.
  SliceFrame(SlicePlane plane, const Vec3& centre, const Vec2& size);
  Vec3 at(const Vec2& mm) const { return corner + mm.x() * right + mm.y() * up; }
  Vec2 flat(const Vec3& x) const { return {(x - corner).dot(right), (x - corner).dot(up)}; }
  double distance(const Vec3& x) const;  ///< mm from the plane
};

/// Segments in mm of the frame.
struct SliceContours {
  std::vector<PlaneSegment> skin;   ///< body against air, where it is the breast's
  std::vector<PlaneSegment> wall;   ///< chest wall, where the breast lies on it
  std::vector<PlaneSegment> gland;  ///< half fibroglandular
};
SliceContours slice_contours(const LabelVolume& labels, const SliceFrame& frame);

/// What of the scan is worth showing: the labelled breast with `margin` mm round it.
struct ShownBox {
  Vec3 low, high;
  Vec3 centre() const { return 0.5 * (low + high); }
};
/// Throws Error (input) when the labels hold no breast.
ShownBox breast_box(const LabelVolume& labels, double margin);
/// Mean place of the fibroglandular tissue, or of the breast where there is none.
Vec3 breast_centre(const LabelVolume& labels);

/// Intensity that is shown white: the 99.5th percentile of the breast's voxels.
double white_level(const Volume<float>& scan, const LabelVolume& labels);
/// 16-bit grey, rows from the top, one value every `pixel` mm; black outside the scan.
struct SliceImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> grey;
};
SliceImage slice_image(const Volume<float>& scan, const SliceFrame& frame, double pixel,
                       double white);

}  // namespace breast
