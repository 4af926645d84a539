// SPDX-License-Identifier: GPL-3.0-or-later
// Correspondence of mammographic views: a point of one mammogram is a column of tissue, and the
// same tissue in another view is a curve. CC to MLO, MLO to CC, or any two compressions of one
// mesh.
#pragma once

#include <optional>
#include <vector>

#include "mesh/hex_mesh.hpp"
#include "projection/framing.hpp"
#include "projection/ray_mesh.hpp"

namespace breast {

/// One material point of a column and its position in every shape.
struct ColumnPoint {
  int element = 0;
  Vec3 local;        ///< in [-1,1]^3
  int stretch = 0;   ///< columns through folds have several stretches of tissue, numbered from 0
  double depth = 0;  ///< mm of tissue passed in the first view, from the paddle
  Vec3 from, to, reference,
      imaged;  ///< mm, patient frame; reference = imaged when the mesh has none
  Vec2 to_uv;  ///< mm in the second image
};

struct MatchedCurve {
  Vec2 from_uv;                     ///< mm in the first image
  std::vector<ColumnPoint> points;  ///< from paddle to detector; empty in air
  bool through_back = false;        ///< whether the column continues behind the mesh
  double length = 0;                ///< mm of the projected curve
  double chord = 0;                 ///< mm between its ends
  double max_deviation = 0;         ///< mm, largest distance from the straight chord
  /// The same for the stress-free column in space, mm: the bending of a column by the first
  /// compression alone, before it is projected in the second view.
  double reference_deviation = 0;
  double behind_image = 0;  ///< mm of the curve that lie behind the second image's posterior edge
  double inside_image = 0;  ///< mm of the curve that lie in the second image
  bool in_air() const { return points.empty(); }
};

/// Follows columns from one compression to another. Both meshes must be compressions of one mesh
/// (connectivity, imaged shape, side) in different views.
class Matcher {
 public:
  /// Keeps references. Throws Error (input) naming the first difference.
  Matcher(const HexMesh& from, const HexMesh& to, Beam beam = Beam::parallel);

  /// `tolerance` is the largest distance in mm of the polyline from the true curve, in the second
  /// image and in every shape. The polyline has at least 64 points.
  MatchedCurve match(const Vec2& from_uv, double tolerance = 0.05) const;

  const HexMesh& from() const { return from_; }
  const HexMesh& to() const { return to_; }
  const ImageFrame& from_frame() const { return from_frame_; }
  const ImageFrame& to_frame() const { return to_frame_; }
  /// Projection of a landmark; no value if the mesh has none of that name.
  std::optional<Vec2> from_landmark(std::string_view name) const;
  std::optional<Vec2> to_landmark(std::string_view name) const;
  bool tissue_in_to(const Vec2& uv) const;
  bool tissue_in_from(const Vec2& uv) const;

  /// The arc used by radiologists: the points of the second image at the same distance from its
  /// nipple as `from_uv` has from that of the first. Only the parts inside the image of the breast
  /// and posterior to the nipple are returned; empty without a nipple.
  std::vector<std::vector<Vec2>> nipple_arc(const Vec2& from_uv) const;
  /// Radius of that arc, mm; 0 without a nipple.
  double nipple_distance(const Vec2& from_uv) const;
  /// The other rule: a straight line at the same depth behind the nipple, along the chest-wall
  /// normal (u), as in the first image. Returns u of that line in the second image; no value
  /// without a nipple.
  std::optional<double> nipple_depth_line(const Vec2& from_uv) const;

 private:
  ColumnPoint point_on(const Ray& ray, const Chord& chord, double distance) const;
  void refine(const Ray& ray, const Chord& chord, double from, double to, double tolerance,
              int depth, std::vector<ColumnPoint>& points) const;

  const HexMesh &from_, &to_;
  ImageFrame from_frame_, to_frame_;
  RayMesh from_rays_, to_rays_;
};

/// Distance from a point to the polyline of the curve, mm (stretches are not joined).
double distance_to_curve(const MatchedCurve& curve, const Vec2& to_uv);

}  // namespace breast
