// SPDX-License-Identifier: GPL-3.0-or-later
// Elements grown outwards from faces of the boundary.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// An edge of a face as its two corner nodes, the smaller first.
using FaceEdge = std::pair<int, int>;

/// Adds one layer of elements over faces; its nodes are made when they are first needed.
class Extrusion {
 public:
  /// The place (mm) of the node over `node` of the faces at a depth of 0.5 or 1 of the layer.
  using Place = std::function<Vec3(int node, double depth)>;
  /// Keeps a reference to the mesh.
  Extrusion(HexMesh& mesh, Place place) : mesh_(mesh), place_(std::move(place)) {}

  /// Adds the element over a face, with nothing but its nodes, and returns its number. Its face 5
  /// lies outermost; `side_over` names those between.
  int element_over(const Face& face);
  /// The node at the full depth of the layer over a node; an element over a face of that node must
  /// exist.
  int node_over(int node) const { return made_.at({node, 2}); }
  /// The face of a new element over edge c of the face beneath (from its corner c to the next).
  static Face side_over(int element, int c);

 private:
  int node(int front, double depth);

  HexMesh& mesh_;
  Place place_;
  std::map<std::pair<int, int>, int> made_;  // (node beneath, half depths) → node of the layer
};

/// The edge from corner c of a face with these nodes to the next corner.
FaceEdge face_edge(const std::vector<int>& nodes, int c);
/// For every edge of the faces, the number of the face that has it, or of the last of several.
std::map<FaceEdge, std::size_t> faces_at_edges(const HexTopology& mesh,
                                               const std::vector<Face>& faces);

}  // namespace breast
