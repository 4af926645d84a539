// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a mesh that one rank solves: its elements, their nodes, and who else has those nodes.
// Every element belongs to one rank; every node is owned by the lowest rank that has an element at it.
#pragma once

#include <memory>
#include <vector>

#include "distributed/ranks.hpp"
#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/constraints.hpp"

namespace breast {

/// The nodes this rank has in common with another, in the order both agree on.
struct SharedNodes {
  int rank = 0;
  std::vector<int> nodes;  ///< of this part
};

/// A node that something holds, the same on every rank that has it.
struct HeldNode {
  int node = 0;  ///< of this part
  NodeConstraint constraint;
};

struct MeshPart {
  /// Elements, nodes and face sets of the part; owned nodes come first. The faces of a set that lie
  /// on other ranks' elements are missing, also where their nodes are present.
  HexMesh mesh;
  int owned = 0;                     ///< nodes
  std::vector<int> nodes, elements;  ///< their numbers in the whole mesh
  std::vector<SharedNodes> shared;   ///< by rank, ascending
  std::vector<HeldNode> held;        ///< by wall and cut, of the whole mesh's face sets
  std::vector<int> sliding;          ///< nodes of the chest wall, ascending; empty where it is held
  std::shared_ptr<const LevelSurface> wall;  ///< null: the mesh has none
};

/// The root's mesh in one part per rank, cut by PT-Scotch along element faces; collective. `mesh` is
/// read on the root only. Throws Error (input) on all ranks for fewer elements than ranks and where
/// the options cannot be met part by part.
MeshPart share_mesh(const Ranks& ranks, const HexMesh& mesh, const MechanicsOptions& options);

/// The part of every element, 0 … parts−1: few faces between parts of nearly the same size.
std::vector<int> partition(const HexMesh& mesh, int parts);

}  // namespace breast
