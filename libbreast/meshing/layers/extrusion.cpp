// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/layers/extrusion.hpp"

#include <algorithm>
#include <array>

#include "mesh/shape.hpp"

namespace breast {

namespace {

/// The place in a face's list of nodes of the one beneath a node of the new element.
std::size_t place_in_face(int order, const Vec3& local) {
  Eigen::Index at = 0;
  quad_shape(order, local.head<2>()).values.maxCoeff(&at);
  return std::size_t(at);
}

}  // namespace

int Extrusion::element_over(const Face& face) {
  const std::vector<int> front = face_nodes(mesh_, face);
  std::vector<int> nodes(std::size_t(mesh_.nodes_per_element()));
  for (int a = 0; a < mesh_.nodes_per_element(); ++a) {
    const Vec3 local = hex_node_local(mesh_.order, a);
    nodes[std::size_t(a)] = node(front[place_in_face(mesh_.order, local)], 0.5 * (1 + local.z()));
  }
  mesh_.connectivity.insert(mesh_.connectivity.end(), nodes.begin(), nodes.end());
  return mesh_.elements() - 1;
}

int Extrusion::node(int front, double depth) {
  if (depth == 0) return front;
  const auto [entry, fresh] = made_.try_emplace({front, int(2 * depth)}, mesh_.nodes());
  if (fresh) {
    const Vec3 x = place_(front, depth);
    mesh_.imaged.push_back(x);
    mesh_.points.push_back(x);
  }
  return entry->second;
}

Face Extrusion::side_over(int element, int c) {
  constexpr std::array<int, 4> side_of_edge = {2, 1, 3, 0};
  return {element, side_of_edge[std::size_t(c)]};
}

FaceEdge face_edge(const std::vector<int>& nodes, int c) {
  return std::minmax(nodes[std::size_t(c)], nodes[std::size_t((c + 1) % 4)]);
}

std::map<FaceEdge, std::size_t> faces_at_edges(const HexTopology& mesh,
                                               const std::vector<Face>& faces) {
  std::map<FaceEdge, std::size_t> at;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::vector<int> nodes = face_nodes(mesh, faces[f]);
    for (int c = 0; c < 4; ++c) at[face_edge(nodes, c)] = f;
  }
  return at;
}

}  // namespace breast
