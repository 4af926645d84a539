// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a hexahedral mesh for other programs as VTK .vtu, with VTK.
#pragma once

#include <filesystem>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Cells: the hexahedra of `points`. CellData tissue (and det_F); PointData displacement_from_scan (and, where there is
/// one, displacement_from_stress_free); FieldData SPACE = LPS, units, history.
void write_state(const std::filesystem::path& file, const HexMesh& mesh);

}  // namespace breast
