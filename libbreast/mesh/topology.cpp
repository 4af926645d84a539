// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>

#include "mesh/landmark_names.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {
// Edge and centre nodes of each face of the 27-node hexahedron, in the order of hex_face_corners.
constexpr std::array<std::array<int, 5>, 6> quadratic_face_rest = {{{16, 15, 19, 11, 20},
                                                                    {9, 18, 13, 17, 21},
                                                                    {8, 17, 12, 16, 22},
                                                                    {19, 14, 18, 10, 23},
                                                                    {11, 10, 9, 8, 24},
                                                                    {12, 13, 14, 15, 25}}};
}  // namespace

const Landmark* HexTopology::landmark(std::string_view name) const {
  const auto found = std::find_if(landmarks.begin(), landmarks.end(),
                                  [&](const Landmark& l) { return l.name == name; });
  if (found != landmarks.end()) return &*found;
  return name == "tumour" ? landmark(artificial_tumour) : nullptr;
}

std::vector<int> face_nodes(const HexTopology& mesh, const Face& face) {
  const int* nodes = mesh.element(face.element);
  std::vector<int> list;
  for (const int corner : hex_face_corners[face.local]) list.push_back(nodes[corner]);
  if (mesh.order == 2) {
    for (const int local : quadratic_face_rest[face.local]) list.push_back(nodes[local]);
  }
  return list;
}

std::vector<int> nodes_of(const HexTopology& mesh, const std::vector<Face>& faces) {
  std::vector<int> all;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    all.insert(all.end(), nodes.begin(), nodes.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<Face> boundary_faces(const HexTopology& mesh) {
  struct Keyed {
    std::array<int, 4> key;
    Face face;
  };
  std::vector<Keyed> all;
  all.reserve(std::size_t(mesh.elements()) * 6);
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int f = 0; f < 6; ++f) {
      Keyed keyed{{}, {e, f}};
      for (int c = 0; c < 4; ++c) keyed.key[c] = mesh.element(e)[hex_face_corners[f][c]];
      std::sort(keyed.key.begin(), keyed.key.end());
      all.push_back(keyed);
    }
  }
  std::sort(all.begin(), all.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key
               ? a.key < b.key
               : std::pair(a.face.element, a.face.local) < std::pair(b.face.element, b.face.local);
  });
  std::vector<Face> boundary;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i + 1;
    while (j < all.size() && all[j].key == all[i].key) ++j;
    if (j == i + 1) boundary.push_back(all[i].face);
    i = j;
  }
  std::sort(boundary.begin(), boundary.end(), [](const Face& a, const Face& b) {
    return std::pair(a.element, a.local) < std::pair(b.element, b.local);
  });
  return boundary;
}

Vec3 element_position(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element,
                      const Vec3& local) {
  const HexShape shape = hex_shape(mesh.order, local);
  Vec3 x = Vec3::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a) {
    x += shape.values[a] * nodal[mesh.element(element)[a]];
  }
  return x;
}

Vec3 landmark_position(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                       const Landmark& landmark) {
  return element_position(mesh, nodal, landmark.element, landmark.local);
}

}  // namespace breast
