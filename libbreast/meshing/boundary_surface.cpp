// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/boundary_surface.hpp"

namespace breast {

namespace {

// A face's nodes on its 2 x 2 or 3 x 3 lattice, from the order of face_nodes.
constexpr std::array<int, 4> flat = {0, 1, 3, 2};
constexpr std::array<int, 9> curved = {0, 4, 1, 7, 8, 5, 3, 6, 2};

void add_part(const HexMesh& mesh, const std::vector<Face>& faces, double part, TriMesh& surface) {
  const int across = mesh.order + 1;
  const int* lattice = mesh.order == 1 ? flat.data() : curved.data();
  std::vector<int> number(mesh.points.size(), -1);
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const int node : nodes) {
      if (number[node] >= 0) continue;
      number[node] = int(surface.points.size());
      surface.points.push_back(mesh.points[node]);
      surface.point_data["part"].push_back(part);
    }
    const auto at = [&](int i, int j) { return number[nodes[lattice[j * across + i]]]; };
    for (int j = 0; j < mesh.order; ++j) {
      for (int i = 0; i < mesh.order; ++i) {
        surface.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        surface.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
}

}  // namespace

TriMesh boundary_surface(const HexMesh& mesh) {
  TriMesh surface;
  add_part(mesh, mesh.skin_faces, 0, surface);
  add_part(mesh, mesh.cut_faces, 1, surface);
  add_part(mesh, mesh.pectoral_faces, 2, surface);
  return surface;
}

}  // namespace breast
