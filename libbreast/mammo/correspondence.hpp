// A point of the CC mammogram is a column of tissue; the same tissue in the MLO mammogram is a
// curve.
#pragma once

#include <optional>
#include <vector>

#include "mammo/framing.hpp"
#include "mammo/ray_mesh.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// One material point of a column and where it is in every shape.
struct ColumnPoint {
  int element = 0;
  Vec3 local;        ///< in [-1,1]^3
  int stretch = 0;   ///< columns through folds have several stretches of tissue, numbered from 0
  double depth = 0;  ///< mm of tissue passed in CC, from the paddle
  Vec3 cc, mlo, reference,
      imaged;   ///< mm, patient frame; reference = imaged when the mesh has none
  Vec2 mlo_uv;  ///< mm in the MLO image
};

struct MatchedCurve {
  Vec2 cc_uv;                       ///< mm in the CC image
  std::vector<ColumnPoint> points;  ///< from paddle to detector; empty in air
  bool through_back = false;        ///< the column goes on behind the mesh
  double length = 0;                ///< mm of the projected curve
  double chord = 0;                 ///< mm between its ends
  double max_deviation = 0;         ///< mm, largest distance from the straight chord
  bool in_air() const { return points.empty(); }
};

/// Both meshes must be compressions of one mesh (connectivity, imaged shape, side).
class Matcher {
 public:
  /// Keeps references. Throws Error (input) naming the first difference.
  Matcher(const HexMesh& cc, const HexMesh& mlo);

  /// `tolerance` mm: the polyline's largest distance from the true curve, in the MLO image and in
  /// every shape. At least 64 points.
  MatchedCurve match(const Vec2& cc_uv, double tolerance = 0.05) const;

  const ImageFrame& cc_frame() const { return cc_frame_; }
  const ImageFrame& mlo_frame() const { return mlo_frame_; }
  /// Projection of a landmark; nothing when the mesh has none of that name.
  std::optional<Vec2> cc_landmark(std::string_view name) const;
  std::optional<Vec2> mlo_landmark(std::string_view name) const;
  bool tissue_in_mlo(const Vec2& uv) const;
  bool tissue_in_cc(const Vec2& uv) const;

  /// Points of the MLO image as far from its nipple as `cc_uv` is from the CC nipple: the
  /// radiologist's arc. Stretches inside the breast's image, posterior of the nipple. Empty without
  /// a nipple.
  std::vector<std::vector<Vec2>> nipple_arc(const Vec2& cc_uv) const;
  /// Radius of that arc, mm; 0 without a nipple.
  double nipple_distance(const Vec2& cc_uv) const;

 private:
  ColumnPoint point_on(const Ray& ray, const Chord& chord, double distance) const;
  void refine(const Ray& ray, const Chord& chord, double from, double to, double tolerance,
              int depth, std::vector<ColumnPoint>& points) const;

  const HexMesh &cc_, &mlo_;
  ImageFrame cc_frame_, mlo_frame_;
  RayMesh cc_rays_, mlo_rays_;
};

/// Distance from a point to the polyline of the curve, mm (stretches are not joined).
double distance_to_curve(const MatchedCurve& curve, const Vec2& mlo_uv);

}  // namespace breast
