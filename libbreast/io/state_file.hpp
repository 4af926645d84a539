// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a hexahedral mesh for other programs as VTK .vtu, with VTK.
#pragma once

#include <filesystem>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Writes the hexahedra of `points` as cells, with CellData tissue (and det_F), PointData
/// displacement_from_scan (and displacement_from_stress_free, if there is one), and FieldData SPACE
/// = LPS, units and history.
void write_state(const std::filesystem::path& file, const HexMesh& mesh);

}  // namespace breast
