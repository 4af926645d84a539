// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges of stretch and volume ratio in each tissue of a compressed breast.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Principal stretches and det F over the quadrature points of a tissue.
struct StrainRange {
  double min_stretch = 1, max_stretch = 1, min_det_F = 1, max_det_F = 1;
};
/// Per tissue present, F from mesh.reference to `x` (3 per node).
std::map<Tissue, StrainRange> strain_ranges(const HexMesh& mesh, const Eigen::VectorXd& x);

/// Smallest det F from mesh.reference to `x` over quadrature points and corners, per element.
std::vector<double> smallest_det_F(const HexMesh& mesh, const Eigen::VectorXd& x);

}  // namespace breast
