// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/layers/muscle_layer.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"
#include "mesh/quality.hpp"
#include "meshing/layers/extrusion.hpp"
#include "surface/thorax.hpp"

namespace breast {

namespace {

/// Unit directions to the ribs at the nodes of the chest wall.
std::map<int, Vec3> ways_to_ribs(const HexMesh& mesh, const LevelSurface* wall) {
  if (wall == nullptr && mesh.geometry && mesh.geometry->thorax) wall = &*mesh.geometry->thorax;
  const NodalFaces normals = nodal_faces(mesh, mesh.pectoral_faces, flatten(mesh.imaged));
  std::map<int, Vec3> ways;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    const std::optional<Level> level = wall == nullptr ? std::nullopt : wall->at(mesh.imaged[node]);
    ways[node] = level ? Vec3(-level->gradient.normalized()) : normals.vector[node].normalized();
  }
  return ways;
}

/// The number of faces that share an edge: one at their rim.
std::map<FaceEdge, int> edge_uses(const HexTopology& mesh, const std::vector<Face>& faces) {
  std::map<FaceEdge, int> uses;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (int c = 0; c < 4; ++c) ++uses[face_edge(nodes, c)];
  }
  return uses;
}

}  // namespace

MuscleThickness measured_muscle_thickness(const LabelVolume& labels, const HexMesh& mesh) {
  constexpr double step = 0.5, first = 2, most = 30;  // mm; the wall lies within 2 mm of its labels
  const auto tissue_at = [&](const Vec3& x) {
    const Vec3 at = labels.grid.to_index(x);
    const Vec3 nearest = at.array().round();
    const int i = int(nearest.x()), j = int(nearest.y()), k = int(nearest.z());
    return labels.grid.contains(i, j, k) ? labels.at(i, j, k) : Tissue::muscle;
  };
  std::vector<double> runs;
  const std::map<int, Vec3> ways = ways_to_ribs(mesh, nullptr);
  for (const auto& [node, way] : ways) {
    const Vec3& wall = mesh.imaged[std::size_t(node)];
    double depth = first;
    while (depth <= most && tissue_at(wall + depth * way) == Tissue::muscle) depth += step;
    if (depth > first && depth <= most) runs.push_back(depth - 0.5 * step);
  }
  if (2 * runs.size() < ways.size()) return {};
  return {median(std::move(runs)), true};
}

double parse_muscle_thickness(const std::string& text) {
  constexpr double most = 30;
  const std::optional<double> value = number_in(text);
  if (value && *value >= 0 && *value <= most) return *value;
  throw input_error("--muscle ", text, ": give a thickness in mm from 0 to ", most,
                    " or 'measured'");
}

void add_muscle_layer(double thickness, HexMesh& mesh, const LevelSurface* wall) {
  const std::vector<Face> front = mesh.pectoral_faces;
  const std::map<FaceEdge, int> uses = edge_uses(mesh, front);
  const std::map<int, Vec3> ways = ways_to_ribs(mesh, wall);
  Extrusion layer(mesh, [&](int node, double depth) {
    return Vec3(mesh.imaged[std::size_t(node)] + depth * thickness * ways.at(node));
  });
  mesh.pectoral_faces.clear();
  for (const Face& face : front) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const int e = layer.element_over(face);
    mesh.tissue.push_back(Tissue::muscle);
    if (!mesh.fibroglandular_fraction.empty()) mesh.fibroglandular_fraction.push_back(0);
    mesh.pectoral_faces.push_back({e, 5});
    for (int c = 0; c < 4; ++c) {
      if (uses.at(face_edge(nodes, c)) == 1) mesh.cut_faces.push_back(Extrusion::side_over(e, c));
    }
  }
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  if (!(quality.min_scaled_jacobian > 0 && quality.min_det_bound > 0)) {
    throw input_error("muscle layer of ", thickness, " mm: element ", quality.worst_element,
                      " folds (scaled Jacobian ", quality.min_scaled_jacobian,
                      "; it must be above 0): the chest wall bends too sharply for it; give less");
  }
  if (mesh.geometry && mesh.geometry->thorax)
    mesh.geometry->thorax = surface_behind(*mesh.geometry->thorax, thickness);
}

}  // namespace breast
