// SPDX-License-Identifier: GPL-3.0-or-later
// The surface on which a function on a lattice of tetrahedra is zero.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <unordered_map>

#include "surface/tri_mesh.hpp"

namespace breast {

/// Marching tetrahedra: every tetrahedron that the surface crosses adds one or two triangles, whose
/// corners lie on its edges and are shared with the tetrahedra beside it.
class MarchingTetrahedra {
 public:
  struct Corner {
    std::size_t id = 0;  ///< the same for the same corner in every tetrahedron
    double above = 0;    ///< value of the function; positive inside, and not zero
    Vec3 place{0, 0, 0};
  };

  /// Crossings keep this share of an edge away from its ends, so that no triangle is degenerate.
  explicit MarchingTetrahedra(double margin = 0) : margin_(margin) {}

  void add(const std::array<Corner, 4>& tetrahedron);
  /// Points and triangles, counter-clockwise seen from outside.
  TriMesh take() { return std::move(mesh_); }

 private:
  struct EdgeHash {
    std::size_t operator()(const std::array<std::size_t, 2>& edge) const {
      return edge[0] * 0x9e3779b97f4a7c15u ^ edge[1];
    }
  };
  int crossing(const Corner* a, const Corner* b);
  void triangle(int a, int b, int c, const Vec3& outward);

  double margin_;
  TriMesh mesh_;
  std::unordered_map<std::array<std::size_t, 2>, int, EdgeHash> point_of_;
};

}  // namespace breast
