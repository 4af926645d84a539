// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/body_mesh.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "mesh/element_order.hpp"
#include "mesh/quality.hpp"
#include "meshing/attempts.hpp"
#include "meshing/layers/skin_layer.hpp"
#include "meshing/match_volume.hpp"

namespace breast {

namespace {

void refuse_folded(const HexMesh& mesh, int attempts) {
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  const bool corners = quality.min_scaled_jacobian > 0;
  if (corners && quality.min_det_bound > 0) return;
  const int element = corners ? quality.worst_det_element : quality.worst_element;
  const Vec3 at = element_position(mesh, mesh.points, element, Vec3::Zero());
  throw input_error("mesh is folded: element ", element, " near (", at.x(), ", ", at.y(), ", ",
                    at.z(), ") mm has scaled Jacobian ",
                    scaled_jacobians(mesh, mesh.points)[element], " and smallest determinant ",
                    quality.min_det, " mm3, at least ", quality.min_det_bound,
                    " between the points (all must be above 0; ", quality.folded,
                    " folded elements), and ", attempts,
                    " meshes with other layers, smoothing and numbers of elements are not better: "
                    "look at this place in the overlay of segment, and fit it with more smoothing "
                    "(fit-hermite --smoothing)");
}

// The skin node nearest to the nipple; −1 if that node is on or beyond the rim.
int nipple_node(const Vec3& nipple, const PlacedNodes& nodes) {
  int nearest = -1;
  double best = std::numeric_limits<double>::infinity();
  for (int a = 0; a < int(nodes.x.size()); ++a) {
    const bool on_skin = nodes.support[a] == Support::skin ||
                         (nodes.support[a] == Support::cut && nodes.st[a].y() >= 1);
    const double distance = (nodes.x[a] - nipple).squaredNorm();
    if (on_skin && distance < best) best = distance, nearest = a;
  }
  return nearest >= 0 && nodes.support[nearest] == Support::skin ? nearest : -1;
}

// Moves the skin node nearest to the nipple to the nipple, together with its surroundings, so that
// the landmark lies on every mesh of a geometry: a coarse face would pass several mm beneath the
// nipple. Not done if it would cost a fifth of the worst element's scaled Jacobian. `held` marks
// the node.
void take_node_to_nipple(const BreastGeometry& geometry, const BodyMap& body,
                         const std::vector<int>& connectivity, SmoothOptions smoothing,
                         std::vector<bool>& held, PlacedNodes& nodes) {
  const Vec3 nipple = geometry.skin.position(geometry.nipple_st);
  const int node = nipple_node(nipple, nodes);
  if (node < 0) return;
  const double shape = worst_shape(connectivity, nodes.x);
  PlacedNodes moved = nodes;
  moved.st[node] = geometry.nipple_st;
  moved.x[node] = nipple;
  held[node] = true;
  smoothing.evaluations /= 2;
  smooth_nodes(connectivity, body, smoothing, held, moved);
  if (worst_shape(connectivity, moved.x) >= 0.8 * shape) {
    nodes = std::move(moved);
  } else {
    held[node] = false;
  }
}

// Places the template in the body. With flat faces, the volume that they cut off is restored;
// curved faces do not need this.
PlacedNodes smoothed_nodes(const BreastGeometry& geometry, const BodyMap& body,
                           const BodyMeshOptions& options, const DomeTemplate& dome,
                           BodyMeshReport& report) {
  PlacedNodes nodes = place_nodes(dome, body);
  SmoothOptions smoothing = options.smoothing;
  if (dome.size.m == 0) smoothing = for_cuboid(smoothing);
  std::vector<bool> held(nodes.x.size(), false);
  const SmoothReport smoothed = smooth_nodes(dome.connectivity, body, smoothing, held, nodes);
  take_node_to_nipple(geometry, body, dome.connectivity, smoothing, held, nodes);
  report.placed_scaled_jacobian = smoothed.before;
  report.evaluations = smoothed.evaluations;
  if (options.order == 1)
    report.skin_shift = match_volume(report.body_volume, body, dome, held, nodes);
  return nodes;
}

HexMesh mesh_of(const BreastGeometry& geometry, const DomeTemplate& dome, const PlacedNodes& nodes,
                const std::vector<int>& layer) {
  HexMesh mesh;
  mesh.points = mesh.imaged = nodes.x;
  mesh.connectivity = dome.connectivity;
  mesh.tissue.assign(mesh.elements(), Tissue::fat);
  for (const int e : layer) mesh.tissue[e] = Tissue::skin;
  mesh.skin_faces = dome.skin_faces;
  mesh.pectoral_faces = dome.wall_faces;
  mesh.cut_faces = dome.cut_faces;
  mesh.side = geometry.side;
  mesh.template_name = dome.size.m > 0 ? "dome" : "cuboid";
  mesh.template_size = {dome.size.n, dome.size.l, dome.size.m, dome.size.k};
  mesh.geometry = geometry;
  mesh.skin_model = !layer.empty() ? SkinModel::layer : SkinModel::none;
  return mesh;
}

struct Meshed {
  HexMesh mesh;
  PlacedNodes nodes;
  BodyMeshReport report;
  double shape = -1;  ///< worst scaled Jacobian; at most 0 if an element is folded
};

Meshed meshed(const BreastGeometry& geometry, const BodyMap& body, const BodyMeshOptions& options) {
  Meshed result;
  result.report.body_volume = body.volume();
  DomeTemplate dome = dome_template(options.size);
  PlacedNodes& nodes = result.nodes;
  nodes = smoothed_nodes(geometry, body, options, dome, result.report);
  std::vector<int> layer;
  if (options.skin_layer > 0) {
    layer = options.size.m > 0 ? add_skin_layer(options.skin_layer, body, dome, nodes)
                               : thin_skin_elements(options.skin_layer, body, dome, nodes);
  }
  result.mesh = mesh_of(geometry, dome, nodes, layer);
  const auto measure = [&] {
    const MeshQuality quality = mesh_quality(result.mesh, result.mesh.points);
    result.shape = quality.min_scaled_jacobian;
    if (!(quality.min_det_bound > 0)) result.shape = std::min(result.shape, 0.0);
  };
  measure();
  if (options.order == 2 && result.shape > 0) {
    result.mesh = raise_order(result.mesh);
    result.report.curved = curve_boundary(body, nodes, result.mesh);
    measure();
  }
  return result;
}

/// The first attempt that is well shaped, otherwise the best of all.
Meshed best_mesh(const BreastGeometry& geometry, const BodyMap& body,
                 const BodyMeshOptions& options) {
  const double wanted = options.size.m > 0 ? wanted_scaled_jacobian : 0;
  Meshed best;
  double asked = 0;
  int tried = 0;
  for (const MeshAttempt& attempt : mesh_attempts(options.size, options.smoothing)) {
    BodyMeshOptions changed = options;
    changed.size = attempt.size;
    changed.smoothing = attempt.smoothing;
    Meshed now = meshed(geometry, body, changed);
    now.report.step = attempt.step;
    if (++tried == 1) asked = now.shape;
    if (tried == 1 || now.shape > best.shape) best = std::move(now);
    if (best.shape > 0 && best.shape >= wanted) break;
  }
  best.report.attempts = tried;
  best.report.asked_scaled_jacobian = asked;
  return best;
}

}  // namespace

HexMesh body_mesh(const BreastGeometry& geometry, const BodyMeshOptions& options,
                  BodyMeshReport* report) {
  const BodyMap body(geometry);
  const double volume = body.volume();
  if (!(volume > 0)) {
    throw input_error(
        "body between the sheets has volume ", volume / 1000,
        " ml: the sheets are inside out (the normal of the skin must point out of the body and "
        "the rims must be counter-clockwise)");
  }
  Meshed best = best_mesh(geometry, body, options);
  HexMesh& mesh = best.mesh;
  refuse_folded(mesh, best.report.attempts);
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  best.report.smoothed_scaled_jacobian =
      *std::min_element(mesh.scaled_jacobian.begin(), mesh.scaled_jacobian.end());
  best.report.mesh_volume = mesh_volume(mesh, mesh.points);
  const auto distance = [&](Hull part, const std::vector<Face>& faces) {
    return boundary_distance(body, part, faces, best.nodes, mesh);
  };
  best.report.skin_distance = distance(Hull::skin, mesh.skin_faces);
  best.report.wall_distance = distance(Hull::wall, mesh.pectoral_faces);
  best.report.cut_distance = distance(Hull::cut, mesh.cut_faces);
  if (report) *report = best.report;
  return std::move(best.mesh);
}

}  // namespace breast
