// SPDX-License-Identifier: GPL-3.0-or-later
// Share of the breast that lies in front of the edge of the image.
#pragma once

#include <optional>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Shares of the whole breast without the muscle behind it, in percent.
struct Coverage {
  double volume = 0;
  std::optional<double> fibroglandular;  ///< absent if there is no such tissue
};

/// Coverage of the shape `x` (3 per node, mm) in front of the start of the plate's rounded edge,
/// from 2×2×2 Gauss points per element, each weighted by its share of the deformed volume.
Coverage coverage(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate);

/// Area of the breast's projection along the beam in front of the edge, cm², in the shape `x` (one
/// position per node, mm): half of ∫ |n·dA| over the skin there, exact where every ray enters and
/// leaves once.
double projected_cm2(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate);

}  // namespace breast
