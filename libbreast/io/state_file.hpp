// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a hexahedral mesh for other programs as VTK .vtu, with VTK.
#pragma once

#include <filesystem>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Writes the hexahedra of `points` as cells, with CellData tissue, PointData displacement_from_scan, and
/// FieldData SPACE = LPS, units and history. CellData det_F and pressure (Pa) and PointData contact_pressure
/// (kPa) and displacement_from_stress_free are added if the mesh has them.
void write_state(const std::filesystem::path& file, const HexMesh& mesh);

}  // namespace breast
