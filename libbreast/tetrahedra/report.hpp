// SPDX-License-Identifier: GPL-3.0-or-later
// Report entries about a tetrahedral mesh.
#pragma once

#include "core/report.hpp"
#include "mesh/tet_mesh.hpp"

namespace breast {

struct TetQuality {
  double volume = 0, least_volume = 0;  ///< mm³
  double least_dihedral = 0;            ///< degrees; 70.5 in a regular tetrahedron
};
TetQuality tet_quality(const TetMesh& mesh);

/// Keys tetrahedra/...; `hex_volume` (mm³) is that of the hexahedra that they replace.
void write_report(const TetMesh& mesh, double hex_volume, Report& report);

}  // namespace breast
