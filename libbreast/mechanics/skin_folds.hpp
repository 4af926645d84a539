// SPDX-License-Identifier: GPL-3.0-or-later
// Folds of the skin that the mesh shows.
#pragma once

#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Edges between two faces of the skin along which it turns inwards by more than half a right angle, which elements of this
/// size cannot follow, and by more than in the imaged shape, which has the fold beneath the breast.
struct SkinFolds {
  int edges = 0;
  double sharpest_deg = 0;  ///< of these edges, between the faces' normals; 0: none
};

/// `deformed`: positions of all nodes, mm.
SkinFolds skin_folds(const HexMesh& mesh, const std::vector<Vec3>& deformed);

}  // namespace breast
