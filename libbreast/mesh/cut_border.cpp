// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cut_border.hpp"

#include <algorithm>
#include <limits>

namespace breast {

std::vector<RimBorder> cut_borders(const HexMesh& mesh) {
  std::vector<RimBorder> borders;
  if (!mesh.geometry || mesh.geometry->rim_skin.empty()) return borders;
  const BreastGeometry& geometry = *mesh.geometry;
  const std::vector<RimBorder> of_rim = rim_borders(geometry);
  std::vector<Vec3> skin, wall;
  for (const Vec2& st : geometry.rim_skin) skin.push_back(geometry.skin.position(st));
  for (const Vec2& st : geometry.rim_wall) wall.push_back(geometry.wall.position(st));
  for (const Face& face : mesh.cut_faces) {
    Vec3 centre = Vec3::Zero();
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const int node : nodes) centre += mesh.imaged[std::size_t(node)] / double(nodes.size());
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t place = 0;
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Vec3 up = skin[i] - wall[i];
      const double height = std::clamp((centre - wall[i]).dot(up) / up.squaredNorm(), 0.0, 1.0);
      const double apart = (centre - wall[i] - height * up).squaredNorm();
      if (apart < nearest) nearest = apart, place = i;
    }
    borders.push_back(of_rim[place]);
  }
  return borders;
}

}  // namespace breast
