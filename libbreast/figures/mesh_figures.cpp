// SPDX-License-Identifier: GPL-3.0-or-later
// Points, geometry, mesh, tissues: Fig. 4.
#include <algorithm>
#include <cmath>

#include "core/table.hpp"
#include "figures/parts.hpp"

namespace breast {

namespace {

// segment marks its data points with `surface`: 0 skin, 1 chest wall.
void add_data_points(Panel& panel, const TriMesh& points) {
  std::vector<Vec3> skin, wall;
  const auto found = points.point_data.find("surface");
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const bool on_wall = found != points.point_data.end() && found->second[i] > 0.5;
    (on_wall ? wall : skin).push_back(points.points[i]);
  }
  // Ten thousand balls are as many as the eye can tell apart.
  const auto thinned = [](const std::vector<Vec3>& all) {
    const std::size_t step = 1 + all.size() / 10000;
    std::vector<Vec3> some;
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    return some;
  };
  if (!skin.empty()) panel.cloud(thinned(skin), dot_mm, palette::skin);
  if (!wall.empty()) panel.cloud(thinned(wall), dot_mm, palette::muscle);
}

// If no mesh states the side, it follows from the centre of the points in x.
Side side_of(const TriMesh& points) {
  double sum = 0;
  for (const Vec3& x : points.points) sum += x.x();
  return sum >= 0 ? Side::left : Side::right;
}

void finish(Panel& panel, const Camera& view, const std::string& caption) {
  panel.look_along(view.direction, view.up);
  panel.caption(caption);
  panel.scale_bar();
  panel.compass();
}

}  // namespace

void draw_points(Picture& picture, const FigureInput& input) {
  need(!input.surfaces.empty(), "points", "a .vtp of data points");
  const TriMesh& points = input.surfaces.front();
  const Side side = side_of(points);
  Panel& left = picture.panel(0, 0, 0.5, 1);
  add_data_points(left, points);
  finish(left, oblique_view(side), "(a) data points: skin (light), chest wall (dark)");
  Panel& right = picture.panel(0.5, 0, 1, 1);
  add_data_points(right, points);
  finish(right, lateral_view(side), "(b) from the side");
}

void draw_geometry(Picture& picture, const FigureInput& input) {
  need(input.geometry.has_value(), "geometry", "a geometry .vtkhdf");
  const BreastGeometry& geometry = *input.geometry;
  const SheetFacets skin = sheet_facets(geometry.skin, geometry.rim_skin, 20);
  const SheetFacets wall = sheet_facets(geometry.wall, geometry.rim_wall, 20);
  const auto add = [&](Panel& panel) {
    panel.surface(skin.inside, {.colour = palette::skin, .opacity = 0.75});
    panel.surface(wall.inside, {.colour = palette::muscle});
    for (const auto& line : skin.patch_lines) panel.tube(line, 0.25, {0.35, 0.25, 0.2});
    for (const auto& line : wall.patch_lines) panel.tube(line, 0.25, {0.1, 0.03, 0.03});
    panel.tube(skin.rim, 0.9, {0.1, 0.3, 0.8});
    panel.tube(wall.rim, 0.9, {0.1, 0.3, 0.8});
    panel.sphere(geometry.nipple, 2.5, {0.75, 0.35, 0.3});
    for (const TriMesh& points : input.surfaces) add_data_points(panel, points);
  };
  Panel& left = picture.panel(0, 0, 0.5, 1);
  add(left);
  finish(left, oblique_view(geometry.side),
         "(a) cubic-Hermite sheets, " + std::to_string(geometry.skin.nu) + " x " +
             std::to_string(geometry.skin.nv) + " patches, rim blue");
  Panel& right = picture.panel(0.5, 0, 1, 1);
  add(right);
  finish(right, lateral_view(geometry.side),
         "(b) " + std::string(side_name(geometry.side)) + " breast from its outer side; mean fit " +
             format_fixed(geometry.fit_mean_mm, 2) + " mm");
}

void draw_mesh(Picture& picture, const FigureInput& input) {
  need(!input.meshes.empty(), "mesh", "a mesh .vtkhdf");
  const HexMesh& mesh = input.meshes.front().mesh;
  Panel& left = picture.panel(0, 0, 0.5, 1);
  add_body(left, mesh, mesh.points, {.edges = true});
  finish(left, oblique_view(mesh.side),
         "(a) " + std::to_string(mesh.elements()) + " hexahedra, " + std::to_string(mesh.nodes()) +
             " nodes (" + mesh.template_name + ")");
  Panel& right = picture.panel(0.5, 0, 1, 1);
  add_body(right, mesh, mesh.points, {.edges = true});
  const Camera front = oblique_view(mesh.side);
  finish(right, {Vec3(front.direction.x(), -front.direction.y(), front.direction.z()), front.up},
         "(b) from behind: chest wall (dark) and cut surface");
}

void draw_tissues(Picture& picture, const FigureInput& input) {
  need(!input.meshes.empty(), "tissues", "a mesh .vtkhdf");
  const HexMesh& mesh = input.meshes.front().mesh;
  const BodyStyle style{.skin_opacity = 0.28, .inside = true, .gland_opacity = 0.85};
  Panel& left = picture.panel(0, 0, 0.5, 1);
  add_body(left, mesh, mesh.points, style);
  const std::string tumour = tumour_words(mesh);
  finish(left, lateral_view(mesh.side),
         "(a) fibroglandular (violet), " + (tumour.empty() ? "" : tumour + " drawn through, ") +
             "muscle (red)");
  Panel& right = picture.panel(0.5, 0, 1, 1);
  add_body(right, mesh, mesh.points, style);
  finish(right, anterior_view(),
         "(b) " + std::string(side_name(mesh.side)) + " breast from the front");
}

}  // namespace breast
