// SPDX-License-Identifier: GPL-3.0-or-later
// How much of the breast lies in front of the edge of the image.
#pragma once

#include <optional>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Of the whole breast without the muscle behind it, percent.
struct Coverage {
  double volume = 0;
  std::optional<double> fibroglandular;  ///< none where there is no such tissue
};

/// Of the shape `x` (3 per node, mm) in front of where the plate's rounded edge starts, at 2×2×2 Gauss
/// points an element, each with its part of the deformed volume.
Coverage coverage(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate);

/// The breast's shadow along the beam in front of the edge, cm², in the shape `x` (one position a node, mm): half of
/// ∫ |n·dA| over the skin there, exact where every ray enters and leaves once.
double projected_cm2(const HexMesh& mesh, const std::vector<Vec3>& x, const Plate& plate);

}  // namespace breast
