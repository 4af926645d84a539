// SPDX-License-Identifier: GPL-3.0-or-later
// Contact pressure on the skin, seen through each plate along the beam.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/table.hpp"
#include "figures/colour_scale.hpp"
#include "figures/parts.hpp"

namespace breast {

namespace {

/// The nodal pressures as per-point values of the facets of the skin.
std::vector<double> facet_values(const HexMesh& mesh) {
  std::vector<Vec3> field(mesh.points.size(), Vec3::Zero());
  for (std::size_t n = 0; n < field.size(); ++n) field[n].x() = mesh.contact_pressure[n];
  std::vector<double> values;
  for (const Vec3& v : face_facets(mesh, field, mesh.skin_faces).points) values.push_back(v.x());
  return values;
}

/// The beginning of the flat part of the plate: the line of the stand-off on the skin.
void add_edge_line(Panel& panel, const HexMesh& mesh, const PlateRecord& plate) {
  const Vec3 lateral = plate.normal.cross(plate.anterior);
  double half_width = 0;
  for (const Vec3& x : mesh.points) {
    half_width = std::max(half_width, std::abs((x - plate.origin).dot(lateral)));
  }
  const Vec3 in_front = plate.origin - 30 * plate.normal;  // mm: before the skin, for the viewer
  panel.tube({in_front - half_width * lateral, in_front + half_width * lateral}, 0.4,
             {0.1, 0.35, 0.65});
}

void add_side(Panel& panel, const HexMesh& mesh, const PlateRecord& plate, double high,
              const std::string& letter) {
  panel.values(face_facets(mesh, mesh.points, mesh.skin_faces), facet_values(mesh), high);
  panel.surface(face_facets(mesh, mesh.points, mesh.cut_faces), {.colour = palette::cut});
  panel.surface(face_facets(mesh, mesh.points, mesh.pectoral_faces), {.colour = palette::muscle});
  add_edge_line(panel, mesh, plate);
  panel.look_along(plate.normal, plate.anterior, 0.14);
  panel.caption(letter + plate.name + ", " + view_name(mesh.contact->view) + ": " +
                format_fixed(plate.force_N, 0) + " N on " + format_fixed(plate.area_cm2, 0) +
                " cm2, mean " + format_fixed(plate.mean_kPa, 1) + " kPa, peak " +
                format_fixed(plate.peak_kPa, 0) + " kPa");
  panel.text({0.5 * panel.size().x(), 16}, "blue: the plate's flat ends, its rounded edge begins", 14,
             palette::ink, Align::centre);
  colour_bar(panel, high, "kPa");
  panel.scale_bar();
  panel.compass();
}

}  // namespace

void draw_pressure(Picture& picture, const FigureInput& input) {
  std::vector<const HexMesh*> meshes;
  double peak = 0;
  for (const auto& named : input.meshes) {
    const HexMesh& mesh = named.mesh;
    if (!mesh.contact || mesh.contact_pressure.size() != mesh.points.size()) continue;
    meshes.push_back(&mesh);
    for (const double p : mesh.contact_pressure) peak = std::max(peak, p);
  }
  need(!meshes.empty(), "pressure", "a compressed .vtkhdf");
  const double high = round_up(std::max(peak, 1e-3), {1, 1.2, 1.6, 2, 2.4, 3.2, 4, 6, 8});
  const std::size_t rows = std::min<std::size_t>(meshes.size(), 2);
  for (std::size_t r = 0; r < rows; ++r) {
    const double top = 1 - double(r) / double(rows), bottom = top - 1 / double(rows);
    const auto& plates = meshes[r]->contact->plates;
    for (std::size_t k = 0; k < plates.size() && k < 2; ++k) {
      Panel& panel = picture.panel(0.5 * double(k), bottom, 0.5 * double(k + 1), top);
      const std::string letter = {'(', char('a' + 2 * r + k), ')', ' '};
      add_side(panel, *meshes[r], plates[k], high, letter);
    }
  }
}

}  // namespace breast
