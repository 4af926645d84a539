// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a tetrahedral mesh for other programs as VTK .vtu, with VTK.
#pragma once

#include <filesystem>

#include "mesh/tet_mesh.hpp"

namespace breast {

/// Writes the tetrahedra and then the boundary triangles, turned outwards, as cells. CellData:
/// tissue (of tetrahedra; 0 for triangles) and part (of triangles: 0 skin, 1 cut, 2 chest wall; 255
/// for tetrahedra).
void write_tet_mesh(const std::filesystem::path& file, const TetMesh& mesh);

}  // namespace breast
