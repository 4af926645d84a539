// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/layers/muscle_layer.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"
#include "mesh/quality.hpp"
#include "mesh/shape.hpp"
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

/// Builds the elements of the layer over the chest-wall faces; nodes are created when they are
/// first needed.
class Layer {
 public:
  Layer(double thickness, HexMesh& mesh, const LevelSurface* wall)
      : thickness_(thickness), mesh_(mesh), ways_(ways_to_ribs(mesh, wall)) {}

  /// The element behind one face: its bottom is the face, and its top lies on the ribs.
  int element_behind(const Face& face) {
    const std::vector<int> front = face_nodes(mesh_, face);
    std::vector<int> nodes(std::size_t(mesh_.nodes_per_element()));
    for (int a = 0; a < mesh_.nodes_per_element(); ++a) {
      const Vec3 local = hex_node_local(mesh_.order, a);
      nodes[std::size_t(a)] = node(front[place_in_face(local)], 0.5 * (1 + local.z()));
    }
    mesh_.connectivity.insert(mesh_.connectivity.end(), nodes.begin(), nodes.end());
    return mesh_.elements() - 1;
  }

 private:
  /// The node of the face in front of a node of the element.
  std::size_t place_in_face(const Vec3& local) const {
    Eigen::Index at = 0;
    quad_shape(mesh_.order, local.head<2>()).values.maxCoeff(&at);
    return std::size_t(at);
  }
  /// The node at this fraction of the layer's depth behind a node of the wall.
  int node(int front, double depth) {
    if (depth == 0) return front;
    const auto [entry, fresh] = made_.try_emplace({front, int(2 * depth)}, mesh_.nodes());
    if (fresh) {
      const Vec3 x = mesh_.imaged[std::size_t(front)] + depth * thickness_ * ways_.at(front);
      mesh_.imaged.push_back(x);
      mesh_.points.push_back(x);
    }
    return entry->second;
  }

  double thickness_;
  HexMesh& mesh_;
  std::map<int, Vec3> ways_;
  std::map<std::pair<int, int>, int> made_;  // (node of the wall, half depths) → node of the layer
};

using FaceEdge = std::pair<int, int>;
FaceEdge edge_of(const std::vector<int>& nodes, int c) {
  return std::minmax(nodes[std::size_t(c)], nodes[std::size_t((c + 1) % 4)]);
}

/// The number of faces that share an edge: one at their rim.
std::map<FaceEdge, int> edge_uses(const HexMesh& mesh, const std::vector<Face>& faces) {
  std::map<FaceEdge, int> uses;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (int c = 0; c < 4; ++c) ++uses[edge_of(nodes, c)];
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
  Layer layer(thickness, mesh, wall);
  mesh.pectoral_faces.clear();
  constexpr std::array<int, 4> side_of_edge = {2, 1, 3, 0};
  for (const Face& face : front) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const int e = layer.element_behind(face);
    mesh.tissue.push_back(Tissue::muscle);
    if (!mesh.fibroglandular_fraction.empty()) mesh.fibroglandular_fraction.push_back(0);
    mesh.pectoral_faces.push_back({e, 5});
    for (int c = 0; c < 4; ++c) {
      if (uses.at(edge_of(nodes, c)) == 1) mesh.cut_faces.push_back({e, side_of_edge[c]});
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
