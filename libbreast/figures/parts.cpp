// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "figures/shapes/gland_surface.hpp"
#include "mesh/compressed_pose.hpp"
#include "mesh/landmark_names.hpp"
#include "projection/framing.hpp"

namespace breast {

Camera lateral_view(Side side) {
  return {Vec3(-lateral_sign(side), 0, 0), Vec3(0, 0, 1)};
}

Camera anterior_view() {
  return {Vec3(0, 1, 0), Vec3(0, 0, 1)};
}

Camera oblique_view(Side side) {
  return {Vec3(-0.75 * lateral_sign(side), 0.75, -0.35), Vec3(0, 0, 1)};
}

Camera plate_view(const HexMesh& mesh) {
  const ViewPose pose = compressed_pose(mesh);
  // Along the plates' edge, a little from the front and above, so that the plates show their faces;
  // from the patient's outer side, which in CC is where the technician stands.
  Vec3 along = pose.e_v;
  if (along.x() * lateral_sign(mesh.side) > 0) along = -along;
  return {along - 0.35 * pose.e_u + 0.22 * pose.n, -pose.n};
}

void add_landmark(Panel& panel, const HexMesh& mesh, const std::vector<Vec3>& nodal,
                  const std::string& name, double radius, const Colour& colour) {
  if (const Landmark* landmark = mesh.landmark(name)) {
    panel.sphere(landmark_position(mesh, nodal, *landmark), radius, colour);
  }
}

void add_body(Panel& panel, const HexMesh& mesh, const std::vector<Vec3>& nodal,
              const BodyStyle& style) {
  Look skin{.colour = palette::skin, .opacity = style.skin_opacity, .edges = style.edges};
  skin.smooth = !style.edges;
  panel.surface(face_facets(mesh, nodal, mesh.skin_faces), skin);
  if (style.back) {
    panel.surface(face_facets(mesh, nodal, mesh.pectoral_faces),
                  {.colour = palette::muscle, .smooth = !style.edges, .edges = style.edges});
    panel.surface(face_facets(mesh, nodal, mesh.cut_faces),
                  {.colour = palette::cut,
                   .opacity = style.skin_opacity < 1 ? 0.6 * style.skin_opacity : 1.0,
                   .smooth = !style.edges,
                   .edges = style.edges});
  }
  if (!style.inside) return;
  panel.surface(gland_facets(mesh, nodal),
                {.colour = palette::gland, .opacity = style.gland_opacity, .shine = 0.25});
  panel.draw_through(true);
  const Facets lesion = tissue_facets(mesh, nodal, Tissue::tumour);
  if (!lesion.quads.empty()) panel.surface(lesion, {.colour = palette::tumour});
  add_landmark(panel, mesh, nodal, "tumour", 4, palette::tumour);
  panel.draw_through(false);
}

std::string tumour_words(const HexMesh& mesh) {
  const Landmark* landmark = mesh.landmark("tumour");
  if (landmark == nullptr) return "";
  return landmark->name == artificial_tumour ? "artificial tumour (yellow)" : "tumour (yellow)";
}

namespace {
// Border of a strip whose points go pairwise from one end to the other.
std::vector<Vec3> outline(const std::vector<Vec3>& pairs) {
  std::vector<Vec3> line;
  for (std::size_t i = 0; i < pairs.size(); i += 2) line.push_back(pairs[i]);
  for (std::size_t i = pairs.size(); i > 0; i -= 2) line.push_back(pairs[i - 1]);
  line.push_back(pairs.front());
  return line;
}
}  // namespace

void add_plates(Panel& panel, const HexMesh& mesh, double opacity) {
  for (const PlateRecord& plate : mesh.contact->plates) {
    const Vec3 lateral = plate.normal.cross(plate.anterior);
    double length = 0, half_width = 0;
    for (const Vec3& x : mesh.points) {
      const Vec3 d = x - plate.origin;
      length = std::max(length, d.dot(plate.anterior));
      if (d.dot(plate.anterior) > 0) half_width = std::max(half_width, std::abs(d.dot(lateral)));
    }
    PlateRecord shown = plate;
    // Clear of the facets of the skin it presses, on the rounded edge too (a parallel surface).
    constexpr double clear = 1.5;  // mm
    shown.origin -= clear * plate.normal;
    shown.edge_radius = std::max(0.0, plate.edge_radius - clear);
    const Facets facets = plate_facets(shown, length + 18, half_width + 15);
    panel.surface(facets, {.colour = palette::plate, .opacity = opacity, .shine = 0.5});
    panel.tube(outline(facets.points), 0.5, {0.35, 0.45, 0.55});
  }
}

void add_image_border(Panel& panel, const HexMesh& mesh) {
  const ImageFrame frame = image_frame(mesh);
  const auto at = [&](double u, double v) {
    return Vec3(frame.pose.origin + u * frame.pose.e_u + v * frame.pose.e_v);
  };
  const std::vector<Vec3> corners{at(0, 0), at(frame.width, 0), at(frame.width, frame.height),
                                  at(0, frame.height)};
  panel.draw_through(true);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    panel.tube({corners[k], corners[(k + 1) % corners.size()]}, k == 3 ? 0.9 : 0.4,
               palette::image_border);
  }
  panel.draw_through(false);
}

std::string compression_caption(const HexMesh& mesh) {
  const ContactRecord& contact = *mesh.contact;
  std::string words = view_name(contact.view) + " (" + std::string(side_name(mesh.side)) + "), " +
                      format_fixed(contact.thickness_mm, 1) + " mm";
  const PlateRecord &paddle = contact.plates[0], &detector = contact.plates[1];
  if (paddle.force_N > 0 || detector.force_N > 0) {
    words +=
        ", " + format_fixed(paddle.force_N, 0) + " / " + format_fixed(detector.force_N, 0) + " N";
  }
  return words;
}

std::vector<std::vector<Vec3>> named_lines(const PolyLines& lines, const std::string& name) {
  std::vector<std::vector<Vec3>> found;
  for (std::size_t i = 0; i < lines.lines.size() && i < lines.line_names.size(); ++i) {
    if (lines.line_names[i] != name) continue;
    found.emplace_back();
    for (const int p : lines.lines[i]) found.back().push_back(lines.points[p]);
  }
  return found;
}

void need(bool given, const std::string& figure, const std::string& what) {
  if (!given) throw input_error("figure ", figure, " needs ", what, ": ", figure_summary(figure));
}

}  // namespace breast
