// SPDX-License-Identifier: GPL-3.0-or-later
// How much of the breast lies in front of the edge of the image.
#pragma once

#include <optional>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Of the whole, percent.
struct Coverage {
  double volume = 0;
  std::optional<double> fibroglandular;  ///< none where there is no such tissue
  double projected_cm2 = 0;  ///< the breast's shadow along the beam in front of the edge
};

/// Of the shape `x` (3 per node, mm) in front of where the plate's rounded edge starts, at 2×2×2 Gauss
/// points an element, each with its part of the deformed volume. The shadow is half of ∫ |n·dA| over the
/// skin there: exact where every ray enters and leaves once.
Coverage coverage(const HexMesh& mesh, const Eigen::VectorXd& x, const Plate& plate);

}  // namespace breast
