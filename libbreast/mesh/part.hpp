// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a mesh: some of its elements, with the nodes they use. Elements and nodes of a part carry
// their numbers in the whole mesh, by which two parts of one mesh are compared.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// The part of a mesh that consists of the given elements (ascending, at least one). Every array
/// follows; elements and nodes keep their order. Boundary faces that arise are cut faces; landmarks
/// and friction records elsewhere are left out, as are the contact's face_rules, which belong to the
/// faces of the whole. Returns the same mesh if it has no other elements.
HexMesh restricted(HexMesh mesh, const std::vector<int>& elements);
/// The same with the elements that a function of the topology chooses.
HexMesh restricted(HexMesh mesh, std::vector<int> (&elements)(const HexTopology&));

/// Where elements and nodes of a part are in another mesh.
struct PartIndices {
  std::vector<int> elements, nodes;

  /// What the whole has, for these elements and nodes alone and in this order; the part has every node
  /// of its elements. Boundary faces that arise are in no set: the body goes on there.
  HexTopology restricted(HexTopology whole) const;
  MeshShape restricted(MeshShape whole) const;
  /// A vector of 3 numbers per node.
  Eigen::VectorXd restricted(const Eigen::VectorXd& whole) const;
  /// The transpose: a vector on the part's nodes as one on all `count` nodes, zero elsewhere.
  Eigen::VectorXd extended(const Eigen::VectorXd& own, int count) const;
};

/// The elements and nodes of `mesh` that have the numbers of those of `part`; none if `mesh` lacks
/// one, or if an element of the same number has other nodes. Either may be a part of a larger mesh.
std::optional<PartIndices> indices_in(const HexMesh& mesh, const HexMesh& part);

/// Whether two meshes have the same elements and nodes, by their numbers in the whole mesh.
bool have_same_elements(const HexMesh& a, const HexMesh& b);

}  // namespace breast
