// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a mesh that one rank solves: its elements, their nodes, and the other ranks that have
// these nodes. Every element belongs to one rank; every node is owned by the lowest rank that has
// an element at it.
#pragma once

#include <memory>
#include <vector>

#include "distributed/ranks.hpp"
#include "mechanics/options.hpp"
#include "mesh/part.hpp"
#include "solve/constraints.hpp"
#include "surface/thorax.hpp"

namespace breast {

/// The nodes that this rank has in common with another, in an order on which both agree.
struct SharedNodes {
  int rank = 0;
  std::vector<int> nodes;  ///< of this part
};

/// Numbers of the part's elements and nodes in the whole mesh, owned nodes first, and what is there.
struct MeshPart : PartIndices {
  /// Elements, nodes and face sets of the part; owned nodes come first. Faces on elements of other
  /// ranks are missing from the sets, even if this part has their nodes.
  HexMesh mesh;
  int owned = 0;                    ///< number of owned nodes
  std::vector<SharedNodes> shared;  ///< in ascending order of rank
  /// Constraints by wall and cut, from the face sets of the whole mesh.
  Constraints held{0};
  /// Nodes of the chest wall, ascending; empty if the wall is held.
  std::vector<int> sliding;
  std::shared_ptr<ThoraxSurface> wall;  ///< null if the mesh has no wall surface
};

/// Divides the root's mesh into one part per rank with PT-Scotch, along element faces; collective.
/// `mesh` is read on the root only. Throws Error (input) on all ranks if there are fewer elements
/// than ranks, or if the options cannot be met part by part.
MeshPart share_mesh(const Ranks& ranks, const HexMesh& mesh, const MechanicsOptions& options);

/// The part of every element, from 0 to parts − 1, such that the parts have nearly the same size
/// and few common faces.
std::vector<int> partition(const HexTopology& mesh, int parts);

}  // namespace breast
