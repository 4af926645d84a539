// SPDX-License-Identifier: GPL-3.0-or-later
// Reading another program's solution back onto the mesh from which the model was exported.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

struct DeckResult {
  std::vector<Vec3> displacement;  ///< mm, in the deck's order of nodes
  std::optional<Vec3> reaction;    ///< total force of the supports on the breast, µN
};

/// Reads a CalculiX result (.frd, ASCII, in the short or long form; the total force comes from the .dat file beside it, if
/// there is one), CalculiX or Abaqus text (.dat), or a FEBio node log (.log: node, ux, uy, uz). The
/// last displacements in the file are used. `nodes` is the expected number. Throws Error (input) if
/// a node is missing, and Error (not converged) if the run stopped before its full load.
DeckResult read_deck_result(const std::filesystem::path& file, int nodes);

/// Sets mesh.points = reference + displacement, with face and element centres of 27-node elements
/// from their 20 nodes. Clears the data that the other program does not provide: pressure, det F,
/// contact. Throws Error (input) for a displacement of more than twice the breast's size.
void apply_displacement(HexMesh& mesh, const std::vector<Vec3>& displacement);

/// Distances between two shapes of one mesh.
struct NodeDifference {
  double mean_mm = 0, max_mm = 0;
  int worst_node = 0;
  /// Largest displacement of the second shape from the reference.
  double largest_displacement_mm = 0;
};
NodeDifference node_difference(const HexMesh& mesh, const HexMesh& other);

}  // namespace breast
