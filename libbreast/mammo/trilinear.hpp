// The map of one 8-node hexahedron as a polynomial: cheap to evaluate, to invert and to cut with a
// ray.
#pragma once

#include <array>

#include "core/types.hpp"

namespace breast {

/// x(ξ,η,ζ) = c0 + c1 ξ + c2 η + c3 ζ + c4 ξη + c5 ηζ + c6 ζξ + c7 ξηζ on [-1,1]^3.
struct Trilinear {
  std::array<Vec3, 8> c;

  /// Corners in VTK order.
  static Trilinear through(const std::array<Vec3, 8>& corners);
  Vec3 at(const Vec3& local) const;
  Mat3 jacobian(const Vec3& local) const;  ///< columns ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ
  /// Newton from `guess` to a residual of `tolerance` mm; false (and `guess` returned) when it
  /// fails.
  bool invert(const Vec3& x, double tolerance, Vec3& local) const;
  double volume() const;  ///< mm³, exact; negative when inside out
};

/// A bilinear patch met by a line.
struct PatchHit {
  double s = 0, r = 0;  ///< patch coordinates in [0,1]: corner 0→1 and 0→3
};
/// Where the patch with corners p (already projected along the line, relative to it) contains the
/// origin: 0, 1 or 2 hits. Coordinates up to 1e-9 outside the patch count as its border.
int patch_hits(const std::array<Vec2, 4>& p, std::array<PatchHit, 2>& hits);

}  // namespace breast
