// SPDX-License-Identifier: GPL-3.0-or-later
// Map of the body's boundary in coordinates of the mesh template: polar (ρ, u) on skin and wall,
// height on the cut between them.
#pragma once

#include <vector>

#include "surface/hermite.hpp"

namespace breast {

/// The coordinate u ∈ [0,1) makes one turn around the rim; equal steps of u are equal lengths of
/// rim, averaged over skin and wall. ρ ∈ [0,1] runs from the pole (skin: geometry.centre; wall: the
/// centroid of its rim) to the rim.
class BodyMap {
 public:
  /// Keeps a reference to the geometry. Throws Error (input) if the rim is not star-shaped about
  /// its pole, or is too short.
  explicit BodyMap(const BreastGeometry& geometry);

  Vec2 skin(double rho, double u) const;  ///< (s,t) on the skin sheet
  Vec2 wall(double rho, double u) const;  ///< (s,t) on the wall sheet
  /// Point of the cut surface: height 0 on the wall's rim, 1 on the skin's.
  Vec3 cut(double height, double u) const;
  /// Volume in mm³ inside skin, cut and wall (of a fine triangulation); negative if the sheets are
  /// inside out.
  double volume() const;
  /// Columns ∂x/∂u and ∂x/∂height of the cut.
  Eigen::Matrix<double, 3, 2> cut_slopes(double height, double u) const;
  double cut_height(double u) const;  ///< mm

  const HermiteSheet& skin_sheet() const { return geometry_.skin; }
  const HermiteSheet& wall_sheet() const { return geometry_.wall; }

 private:
  void choose_pole();
  void choose_start();
  Vec2 rim(const std::vector<Vec2>& curve, double u) const;

  const BreastGeometry& geometry_;
  Vec2 skin_pole_, wall_pole_;
  double start_ = 0;  ///< start of u, as a fraction of the rim from its first point
  std::vector<double>
      cumulative_;  ///< u at each rim point, beginning with 0; the last entry 1 closes the curve
};

}  // namespace breast
