// SPDX-License-Identifier: GPL-3.0-or-later
// A tetrahedral mesh for export to other solvers; libbreast does not compute with it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"

namespace breast {

struct TetMesh {
  std::vector<Vec3> points;                    ///< mm, LPS
  std::vector<std::array<int, 4>> tetrahedra;  ///< positive volume, node order as VTK_TETRA
  std::vector<Tissue> tissue;                  ///< per tetrahedron
  std::vector<std::array<int, 3>> triangles;   ///< the boundary, with inward normals
  std::vector<std::uint8_t> part;              ///< per triangle: 0 skin, 1 cut, 2 chest wall
  History history;
};

/// Volume of one tetrahedron, mm³.
inline double tetrahedron_volume(const TetMesh& mesh, std::size_t t) {
  const auto& c = mesh.tetrahedra[t];
  const Vec3& a = mesh.points[c[0]];
  return (mesh.points[c[1]] - a).cross(mesh.points[c[2]] - a).dot(mesh.points[c[3]] - a) / 6;
}

}  // namespace breast
