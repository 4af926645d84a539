#include "meshing/boundary_surface.hpp"

namespace breast {

namespace {

void add_part(const HexMesh& mesh, const std::vector<Face>& faces, double part, TriMesh& surface) {
  std::vector<int> number(mesh.points.size(), -1);
  for (const Face& face : faces) {
    std::array<int, 4> corner{};
    for (int c = 0; c < 4; ++c) {
      const int node = mesh.element(face.element)[hex_face_corners[face.local][c]];
      if (number[node] < 0) {
        number[node] = int(surface.points.size());
        surface.points.push_back(mesh.points[node]);
        surface.point_data["part"].push_back(part);
      }
      corner[c] = number[node];
    }
    surface.triangles.push_back({corner[0], corner[1], corner[2]});
    surface.triangles.push_back({corner[0], corner[2], corner[3]});
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
