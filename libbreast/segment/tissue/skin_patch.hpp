// SPDX-License-Identifier: GPL-3.0-or-later
// Patches of the skin surface in the coordinates of their tangent plane.
#pragma once

#include <vector>

#include "segment/grid/grid_ops.hpp"

namespace breast {

/// A voxel face adjacent to air: its centre and its share of the surface's area vector (outward).
/// Positions are in mm from the grid's first voxel, along the grid's axes.
struct SkinFace {
  Vec3 centre, area;
};
/// Faces of the body within `reach` mm of a place; faces on the border of the grid are excluded.
std::vector<SkinFace> skin_faces(const Mask& body, const Vec3& about, double reach);

struct TangentFrame {
  Vec3 origin, u, v, out;
  Vec3 local(const Vec3& p) const {
    return {(p - origin).dot(u), (p - origin).dot(v), (p - origin).dot(out)};
  }
  Vec3 place(double a, double b, double h) const { return origin + a * u + b * v + h * out; }
};
/// Outward direction = mean of the faces' area vectors.
TangentFrame tangent_frame(const std::vector<SkinFace>& faces, const Vec3& origin);

/// h = q0 + q1 a + q2 b + q3 a^2 + q4 a b + q5 b^2
using Quadric = Eigen::Matrix<double, 6, 1>;
Quadric monomials(double a, double b);
/// Least-squares height over the tangent plane of the faces between two radii (mm), weighted by the
/// area seen from outside.
Quadric quadric_through(const std::vector<SkinFace>& faces, const TangentFrame& frame,
                        double inside, double outside);

}  // namespace breast
