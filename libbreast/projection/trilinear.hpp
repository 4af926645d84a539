// SPDX-License-Identifier: GPL-3.0-or-later
// The isoparametric map of one 8-node hexahedron as a polynomial, for fast evaluation and
// inversion.
#pragma once

#include <array>

#include "core/types.hpp"

namespace breast {

/// x(ξ,η,ζ) = c0 + c1 ξ + c2 η + c3 ζ + c4 ξη + c5 ηζ + c6 ζξ + c7 ξηζ on [-1,1]^3.
struct Trilinear {
  std::array<Vec3, 8> c;

  static Vec3 corner(int a);  ///< its (ξ,η,ζ), VTK order
  /// Corners in VTK order.
  static Trilinear through(const std::array<Vec3, 8>& corners);
  Vec3 at(const Vec3& local) const;
  Mat3 jacobian(const Vec3& local) const;  ///< columns ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ
  /// Finds the local coordinates of x by Newton's method to a residual of `tolerance` mm, starting from
  /// those in `local`. Returns false, and leaves `local` as it was, if it fails.
  bool invert(const Vec3& x, double tolerance, Vec3& local) const;
  double volume() const;  ///< mm³, exact; negative when inside out
};

}  // namespace breast
