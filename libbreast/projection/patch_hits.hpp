// SPDX-License-Identifier: GPL-3.0-or-later
// Intersections of a bilinear patch with a packet of neighbouring rays, computed with vector
// instructions.
#pragma once

#include <array>

namespace breast {

inline constexpr int packet_rays = 8;
/// One number per ray of a packet.
struct alignas(64) Lanes {
  std::array<double, packet_rays> of{};
};

/// A patch with corners 0..3 in the plane across the rays, relative to each ray: the ray is at 0.
struct PatchCorners {
  std::array<const Lanes*, 4> x, y;
};

/// Up to two hits per ray: patch coordinates in [0,1], s from corner 0 to 1, r from 0 to 3.
struct PatchHits {
  std::array<Lanes, 2> s, r;
  std::array<unsigned, 2> hit;  ///< bit k: the hit of ray k exists
};

/// Coordinates up to 1e-9 outside the patch count as its border.
void patch_hits(const PatchCorners& corners, PatchHits& hits);

}  // namespace breast
