// SPDX-License-Identifier: GPL-3.0-or-later
// Filter for the pressures of 8-node elements, which oscillate from element to element (the inf-sup
// constant decreases with the mesh size, tests/verify/inf_sup.cpp); the displacements do not show
// it.
#pragma once

#include <map>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Per element: value at its centre of the linear function fitted to the pressures of the elements
/// of its tissue around it, weighted by volume times the number of shared nodes. On a regular mesh
/// this annihilates every oscillation of period two (at a corner of the mesh a quarter stays) and
/// reproduces linear pressures exactly.
std::vector<double> filter_pressure(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                                    const std::vector<double>& pressure);

struct PressureQuality {
  /// ‖p − p_filtered‖/‖p − mean p‖ over the tissue's volume: 0 smooth, 1 nothing but oscillation.
  double checkerboard = 0;
  double least = 0, greatest = 0;  ///< filtered, Pa
};
/// The quality of the pressures in every tissue present.
std::map<Tissue, PressureQuality> pressure_quality(const HexTopology& mesh,
                                                   const std::vector<Vec3>& nodal,
                                                   const std::vector<double>& pressure,
                                                   const std::vector<double>& filtered);

}  // namespace breast
