// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/muscle_front.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"
#include "mesh/quality.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

namespace {

using Corners = std::array<int, 4>;

Corners sorted_corners(const HexTopology& mesh, const Face& face) {
  Corners corners;
  for (int c = 0; c < 4; ++c)
    corners[c] = mesh.element(face.element)[hex_face_corners[face.local][c]];
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

std::vector<Face> muscle_front(const HexTopology& mesh) {
  std::set<Corners> of_muscle;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[e] != Tissue::muscle) continue;
    for (int local = 0; local < 6; ++local) of_muscle.insert(sorted_corners(mesh, {e, local}));
  }
  if (of_muscle.empty()) return of_breast(mesh, mesh.pectoral_faces);
  std::vector<Face> front;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[e] == Tissue::muscle || is_around_breast(mesh, e)) continue;
    for (int local = 0; local < 6; ++local) {
      if (of_muscle.contains(sorted_corners(mesh, {e, local}))) front.push_back({e, local});
    }
  }
  return front;
}

double muscle_thickness(const HexMesh& mesh) {
  double volume = 0, area = 0;
  const std::vector<double> volumes = element_volumes(mesh, mesh.imaged);
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[e] == Tissue::muscle) volume += volumes[e];
  }
  if (!(volume > 0)) return 0;
  for (const double part : nodal_faces(mesh, muscle_front(mesh), flatten(mesh.imaged)).area)
    area += part;
  return volume / area;
}

}  // namespace breast
