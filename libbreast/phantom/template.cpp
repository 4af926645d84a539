// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/template.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "mesh/lattice.hpp"
#include "mesh/quality.hpp"
#include "phantom/block_lattice.hpp"

namespace breast {

namespace {

// The half ball is stretched from the slab's centre to the skin; the slab runs straight from wall
// to its top disc.
Vec3 stress_free_place(const BlockLattice::Place& place, const BreastShape& shape,
                       const MeridianMap& map) {
  const Vec3 centre = shape.at(0, 0, map.fold_height());
  const double azimuth = elementary::atan2(place.ball.y(), place.ball.x());
  const double flat = std::hypot(place.ball.x(), place.ball.y());
  if (place.dome) {
    const double polar = elementary::atan2(flat, place.ball.z()) / (0.5 * std::numbers::pi);
    return centre + place.ball.norm() * (map.skin(polar, azimuth) - centre);
  }
  const Vec3 top =
      flat > 1 ? map.skin(flat, azimuth) : Vec3(centre + flat * (map.skin(1, azimuth) - centre));
  return top + (1 - place.level) * (map.wall(flat, azimuth) - top);
}

// Newton's method along the normal to the zero of a distance function.
template <class Distance, class Normal>
Vec3 put_onto(Vec3 x, Distance distance, Normal normal) {
  for (int i = 0; i < 4; ++i) x -= distance(x) * normal(x);
  return x;
}

std::vector<Face> faces(const std::vector<BlockLattice::Side>& sides) {
  std::vector<Face> out;
  for (const auto& side : sides) out.push_back({side.element, side.local});
  return out;
}

}  // namespace

HexMesh phantom_mesh(const BreastShape& shape, const MeridianMap& map, const MeshParameters& size) {
  if (size.core % 2 != 0) {
    throw input_error("phantom mesh core ", size.core, ": must be even for a node at the nipple");
  }
  const BlockLattice lattice(size);
  const auto& places = lattice.places();
  HexMesh mesh;
  mesh.order = size.order;
  mesh.side = shape.side();
  mesh.template_name = "phantom";
  mesh.template_size = {size.core, size.shell, size.slab, size.rise};
  mesh.points.resize(places.size());
#pragma omp parallel for schedule(static) num_threads(threads())
  for (std::size_t n = 0; n < places.size(); ++n) {
    Vec3 x = stress_free_place(places[n], shape, map);
    const Torso& torso = shape.torso();
    if (places[n].skin)
      x = put_onto(
          x, [&](const Vec3& p) { return shape.skin_distance(p); },
          [&](const Vec3& p) { return shape.skin_normal(p); });
    if (places[n].wall)
      x = put_onto(
          x, [&](const Vec3& p) { return torso.wall_distance(p); },
          [&](const Vec3& p) { return torso.wall_normal(p); });
    mesh.points[n] = x;
  }
  const int per_element = mesh.nodes_per_element();
  const int* vtk = lattice::vtk_nodes(size.order);
  mesh.connectivity.resize(lattice.elements.size() * per_element);
  for (std::size_t e = 0; e < lattice.elements.size(); ++e)
    for (int a = 0; a < per_element; ++a)
      mesh.connectivity[e * per_element + vtk[a]] = lattice.elements[e][a];
  mesh.skin_faces = faces(lattice.skin);
  mesh.pectoral_faces = faces(lattice.wall);
  mesh.cut_faces = faces(lattice.cut);
  mesh.nipple_node = lattice.nipple;
  mesh.imaged = mesh.reference = mesh.points;
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  if (!(quality.min_det > 0)) {
    throw input_error("phantom mesh, element ", quality.worst_det_element, ": det ",
                      quality.min_det, " mm3 must be positive; try a less extreme breast");
  }
  return mesh;
}

}  // namespace breast
