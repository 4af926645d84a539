// SPDX-License-Identifier: GPL-3.0-or-later
#include "tetrahedra/tissue.hpp"

#include "mesh/locate.hpp"

namespace breast {

void copy_tissue(const HexMesh& hexahedra, TetMesh& mesh) {
  const Locator locator(hexahedra, hexahedra.points);
  mesh.tissue.clear();
  int hint = -1;
  for (const auto& tetrahedron : mesh.tetrahedra) {
    Vec3 centroid = Vec3::Zero();
    for (const int node : tetrahedron) centroid += mesh.points[node] / 4;
    const auto inside = locator.find(centroid, hint);
    hint = inside ? inside->element : locator.nearest(centroid).element;
    mesh.tissue.push_back(hexahedra.tissue[hint]);
  }
}

}  // namespace breast
