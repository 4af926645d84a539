// SPDX-License-Identifier: GPL-3.0-or-later
// The cut of a breast in a solved shape, which separates the breast from the chest beside it.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// The closed curves in which the cut meets wall and skin, described by radius and height as
/// functions of the azimuth. The axis passes through the centre of the breast on the wall and has
/// the direction of the mean normal of the wall.
class CutOutline {
 public:
  /// Takes the shape in mesh.points. Throws Error (failed) if a curve does not enclose the axis.
  explicit CutOutline(const HexMesh& mesh);
  /// Whether a point in front of the chest wall lies more than `margin` mm on the breast's side of
  /// the cut (extended straight outwards).
  bool inside(const Vec3& x, double margin) const;

 private:
  struct Corner {
    double azimuth = 0, radius = 0, height = 0;
  };
  using Curve =
      std::vector<Corner>;  ///< in the order of the azimuth, with some overlap beyond −π and π

  Corner place_of(const Vec3& x) const;
  Curve curve_through(const HexMesh& mesh, const std::vector<int>& nodes) const;
  static Corner at(const Curve& curve, double azimuth);

  Vec3 middle_, axis_, u_, v_;
  Curve wall_, skin_;
};

}  // namespace breast
