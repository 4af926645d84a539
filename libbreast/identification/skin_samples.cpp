// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/skin_samples.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "mesh/surroundings.hpp"

namespace breast {

namespace {

Vec3 middle_of(int local_face) {
  Vec3 local = Vec3::Zero();
  local[local_face / 2] = local_face % 2 == 0 ? -1 : 1;
  return local;
}

std::set<int> rim_nodes(const HexTopology& mesh) {
  std::set<int> rim;
  for (const std::vector<Face>* faces : {&mesh.cut_faces, &mesh.pectoral_faces}) {
    const std::vector<int> nodes = nodes_of(mesh, *faces);
    rim.insert(nodes.begin(), nodes.end());
  }
  return rim;
}

}  // namespace

std::vector<Location> skin_samples(const HexMesh& mesh, double spacing) {
  const std::set<int> rim = rim_nodes(mesh);
  std::vector<Location> samples;
  std::vector<Vec3> places;
  for (const Face& face : of_breast(mesh, mesh.skin_faces)) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    if (std::any_of(nodes.begin(), nodes.end(), [&](int n) { return rim.contains(n); })) continue;
    const Vec3 local = middle_of(face.local),
               at = element_position(mesh, mesh.imaged, face.element, local);
    const bool close = std::any_of(places.begin(), places.end(),
                                   [&](const Vec3& p) { return (p - at).norm() < spacing; });
    if (close) continue;
    places.push_back(at);
    samples.push_back({face.element, local, 0});
  }
  return samples;
}

std::optional<SurfaceDistance> distance_to(const SeenSurface& surface, const Vec3& x) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::size_t k = 0; k < surface.points.size(); ++k) {
    const double apart = (x - surface.points[k]).squaredNorm();
    if (apart < nearest) nearest = apart, at = k;
  }
  const Vec3 away = x - surface.points[at], &normal = surface.normals[at];
  const double along = away.dot(normal);
  if (!((away - along * normal).norm() <= surface.reach)) return {};
  return SurfaceDistance{along, normal};
}

}  // namespace breast
