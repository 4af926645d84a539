// SPDX-License-Identifier: GPL-3.0-or-later
#include "tetrahedra/delaunay.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <map>

#include "core/error.hpp"
#include "tetrahedra/welded_surface.hpp"

namespace breast {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Domain =
    CGAL::Mesh_domain_with_polyline_features_3<CGAL::Polyhedral_mesh_domain_3<Surface, Kernel>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

Point to_cgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Surface to_cgal(const WeldedSurface& welded) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Vec3& p : welded.points) vertices.push_back(surface.add_vertex(to_cgal(p)));
  for (const auto& t : welded.triangles) {
    const auto face = surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    if (face == Surface::null_face()) throw input_error("surface: is not a manifold");
  }
  return surface;
}

Complex fill(const Surface& surface, const WeldedSurface& welded, double edge) {
  constexpr double facet_angle = 25, radius_edge_ratio = 2, sliver_angle = 12;  // degrees, 1
  Domain domain(surface);
  std::vector<std::vector<Point>> seams;
  for (const auto& line : welded.seams) {
    seams.emplace_back();
    for (const int node : line) seams.back().push_back(to_cgal(welded.points[node]));
  }
  domain.add_features(seams.begin(), seams.end());
  namespace parameters = CGAL::parameters;
  const Criteria criteria(parameters::edge_size = edge, parameters::facet_angle = facet_angle,
                          parameters::facet_size = edge, parameters::facet_distance = 0.03 * edge,
                          parameters::cell_radius_edge_ratio = radius_edge_ratio,
                          parameters::cell_size = edge);
  return CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb(),
                                    parameters::exude(parameters::sliver_bound = sliver_angle));
}

// The part of the given surface that is nearest to the centre of each boundary triangle.
void add_boundary(const Complex& complex, const Surface& surface, const WeldedSurface& welded,
                  const std::map<Complex::Vertex_handle, int>& number, TetMesh& mesh) {
  Tree tree(faces(surface).begin(), faces(surface).end(), surface);
  tree.accelerate_distance_queries();
  for (auto f = complex.facets_in_complex_begin(); f != complex.facets_in_complex_end(); ++f) {
    auto [cell, opposite] = *f;
    if (!complex.is_in_complex(cell)) {
      std::tie(cell, opposite) = complex.triangulation().mirror_facet(*f);
    }
    std::array<int, 3> corner{};
    for (int c = 0; c < 3; ++c) {
      corner[c] = number.at(cell->vertex(Triangulation::vertex_triple_index(opposite, c)));
    }
    const Vec3 middle =
        (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3;
    const auto nearest = tree.closest_point_and_primitive(to_cgal(middle)).second;
    mesh.triangles.push_back(corner);
    mesh.part.push_back(std::uint8_t(welded.part[nearest.idx()]));
  }
}

}  // namespace

TetMesh delaunay_tetrahedra(const TriMesh& given, double edge) {
  if (!(edge > 0 && std::isfinite(edge)))
    throw input_error("tetrahedra: edge of ", edge, " mm must be above 0");
  const WeldedSurface welded = weld(given);
  const Surface surface = to_cgal(welded);
  const Complex complex = fill(surface, welded, edge);
  TetMesh mesh;
  std::map<Complex::Vertex_handle, int> number;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    std::array<int, 4> corner{};
    for (int c = 0; c < 4; ++c) {
      const auto [entry, fresh] = number.try_emplace(cell->vertex(c), int(mesh.points.size()));
      corner[c] = entry->second;
      const auto& p = cell->vertex(c)->point();
      if (fresh) mesh.points.emplace_back(p.x(), p.y(), p.z());
    }
    mesh.tetrahedra.push_back(corner);
    if (!(tetrahedron_volume(mesh, mesh.tetrahedra.size() - 1) > 0))
      throw failed_error("tetrahedra: number ", mesh.tetrahedra.size() - 1, " is flat");
  }
  mesh.tissue.assign(mesh.tetrahedra.size(), Tissue::fat);
  add_boundary(complex, surface, welded, number, mesh);
  return mesh;
}

}  // namespace breast
