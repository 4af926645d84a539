#include "meshing/body_mesh.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "mesh/quality.hpp"
#include "meshing/match_volume.hpp"
#include "meshing/skin_layer.hpp"

namespace breast {

namespace {

void refuse_folded(const HexMesh& mesh) {
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  const bool corners = quality.min_scaled_jacobian > 0;
  if (corners && quality.min_det > 0) return;
  const int element = corners ? quality.worst_det_element : quality.worst_element;
  const Vec3 at = element_position(mesh, mesh.points, element, Vec3::Zero());
  throw input_error("mesh is folded: element ", element, " near (", at.x(), ", ", at.y(), ", ",
                    at.z(), ") mm has scaled Jacobian ",
                    scaled_jacobians(mesh, mesh.points)[element], " and smallest determinant ",
                    quality.min_det, " mm3 (both must be above 0; ", quality.folded,
                    " folded elements): try --template dome, another --elements or "
                    "--dome, or fit-hermite with more smoothing");
}

}  // namespace

HexMesh body_mesh(const BreastGeometry& geometry, const BodyMeshOptions& options,
                  BodyMeshReport* report) {
  const BodyMap body(geometry);
  BodyMeshReport local;
  local.body_volume = body.volume();
  if (!(local.body_volume > 0)) {
    throw input_error(
        "body between the sheets has volume ", local.body_volume / 1000,
        " ml: the sheets are inside out (normal of the skin must point out of the body, "
        "rims counter-clockwise)");
  }
  DomeTemplate dome = dome_template(options.size);
  PlacedNodes nodes = place_nodes(dome, body);
  const SmoothReport smoothed = smooth_nodes(dome.connectivity, body, options.smoothing, {}, nodes);
  local.placed_scaled_jacobian = smoothed.before;
  local.evaluations = smoothed.evaluations;
  local.skin_shift = match_volume(local.body_volume, body, dome, nodes);
  int layer_elements = 0;
  if (options.skin_layer > 0) {
    layer_elements = add_skin_layer(options.skin_layer, body, dome, nodes);
  }
  HexMesh mesh;
  mesh.points = mesh.imaged = nodes.x;
  mesh.connectivity = dome.connectivity;
  mesh.tissue.assign(mesh.elements(), Tissue::fat);
  std::fill(mesh.tissue.end() - layer_elements, mesh.tissue.end(), Tissue::skin);
  mesh.skin_faces = dome.skin_faces;
  mesh.pectoral_faces = dome.wall_faces;
  mesh.cut_faces = dome.cut_faces;
  mesh.side = geometry.side;
  mesh.template_name = options.size.m > 0 ? "dome" : "cuboid";
  mesh.template_size = {options.size.n, options.size.l, options.size.m, options.size.k};
  mesh.geometry = geometry;
  mesh.skin_model = layer_elements > 0 ? SkinModel::layer : SkinModel::none;
  refuse_folded(mesh);
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  local.smoothed_scaled_jacobian =
      *std::min_element(mesh.scaled_jacobian.begin(), mesh.scaled_jacobian.end());
  local.mesh_volume = mesh_volume(mesh, mesh.points);
  if (report) *report = local;
  return mesh;
}

}  // namespace breast
