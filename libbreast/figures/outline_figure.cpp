// SPDX-License-Identifier: GPL-3.0-or-later
// Overlaid shapes of one breast, which show the motion of its tissue from the scan to another
// posture.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/table.hpp"
#include "figures/parts.hpp"
#include "figures/shapes/plane_section.hpp"

namespace breast {

namespace {

constexpr std::array<Colour, 4> shape_colours = {
    {{0.15, 0.35, 0.70}, {0.85, 0.40, 0.10}, {0.20, 0.55, 0.30}, {0.55, 0.30, 0.60}}};
constexpr Colour wall_colour{0.35, 0.20, 0.18};
constexpr Colour muscle_colour{0.80, 0.25, 0.35};
constexpr double line_pixels = 3, thin_pixels = 1.5, outline_letters = 17;
constexpr double landmark_ring_pixels = 6;

const Colour& colour_of(std::size_t shape) {
  return shape_colours[shape % shape_colours.size()];
}

std::string posture_of(const Vec3& gravity) {
  if (gravity.norm() == 0) return "stress-free";
  if (-gravity.y() > 0.9 * gravity.norm()) return "prone";
  if (gravity.y() > 0.9 * gravity.norm()) return "supine";
  return "under gravity " + format_fixed(gravity.x(), 0) + ", " + format_fixed(gravity.y(), 0) +
         ", " + format_fixed(gravity.z(), 0) + " mm/s2";
}

void add_section(Panel& panel, const Shape& shape, double height, const Colour& colour) {
  const auto add = [&](const std::vector<Face>& faces, double width) {
    panel.strokes(
        plane_section(face_facets(*shape.mesh, *shape.points, faces), Vec3::UnitZ(), height),
        colour, width);
  };
  add(shape.mesh->skin_faces, line_pixels);
  add(shape.mesh->pectoral_faces, line_pixels);
  add(shape.mesh->cut_faces, thin_pixels);
}

/// The name of the surface on which the breast slides; empty if there is none. With muscle in the mesh it is the back of the
/// muscle, otherwise the chest wall, which is its front.
std::string wall_words(const HexMesh& mesh) {
  if (!mesh.geometry || !mesh.geometry->thorax) return "";
  const bool muscle =
      std::find(mesh.tissue.begin(), mesh.tissue.end(), Tissue::muscle) != mesh.tissue.end();
  return muscle ? "ribs: back of the muscle" : "chest wall";
}

/// The wall surface at a height, as a line.
void add_wall(Panel& panel, const HexMesh& mesh, double height) {
  if (!mesh.geometry || !mesh.geometry->thorax) return;
  const ThoraxSurface& thorax = *mesh.geometry->thorax;
  const double above = height - thorax.origin.z();
  if (!(above >= thorax.height_low && above <= thorax.height_high)) return;
  std::vector<std::array<Vec3, 2>> pieces;
  constexpr int steps = 120;
  const auto at = [&](int i) {
    return thorax.point(thorax.angle_low + (thorax.angle_high - thorax.angle_low) * i / steps,
                        above);
  };
  for (int i = 0; i < steps; ++i) pieces.push_back({at(i), at(i + 1)});
  panel.strokes(pieces, wall_colour, thin_pixels);
}

Vec3 place_in(const Shape& shape, const Landmark& landmark) {
  return landmark_position(*shape.mesh, *shape.points, landmark);
}

double moved_mm(const std::vector<Shape>& shapes, std::size_t k, const Landmark& landmark) {
  return (place_in(shapes[k], landmark) - place_in(shapes.front(), landmark)).norm();
}

/// Whether the motion of a landmark is stated in words: of many, only those that everybody looks for,
/// since words would hide one another.
bool is_named(const HexMesh& mesh, const Landmark& landmark) {
  constexpr std::size_t few = 8;
  return mesh.landmarks.size() <= few || landmark.name == "nipple" || landmark.name == "tumour";
}

/// Rings at the positions of the landmarks in every shape, and arrows from the first to the last.
void add_arrows(Panel& panel, const std::vector<Shape>& shapes) {
  for (const Landmark& landmark : shapes.front().mesh->landmarks) {
    const Vec3 from = place_in(shapes.front(), landmark), to = place_in(shapes.back(), landmark);
    panel.arrow(from, to, palette::ink);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      panel.ring(place_in(shapes[k], landmark), landmark_ring_pixels, colour_of(k));
    }
    if (shapes.size() < 2 || !is_named(*shapes.front().mesh, landmark)) continue;
    std::string name = landmark.name;
    std::replace(name.begin(), name.end(), '_', ' ');
    // Beyond the head of the arrow, where the text hides no mark.
    const Vec2 start = panel.to_pixel(from), tip = panel.to_pixel(to);
    const bool rightwards = tip.x() >= start.x();
    panel.label(tip + Vec2(rightwards ? 12 : -12, 0),
                name + " " + format_fixed(moved_mm(shapes, shapes.size() - 1, landmark), 0) + " mm",
                outline_letters - 2, palette::ink, rightwards ? Align::left : Align::right);
  }
}

/// Points of a second scan about a height: a slab as thick as its slices are apart.
void add_seen(Panel& panel, const TriMesh& seen, double height) {
  constexpr double thinnest = 1.3;  // mm to either side
  std::vector<Vec3> skin, wall;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& point : seen.points) nearest = std::min(nearest, std::abs(point.z() - height));
  const auto kind = seen.point_data.find("surface");
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    if (std::abs(seen.points[i].z() - height) > std::max(thinnest, 1.5 * nearest)) continue;
    const bool on_wall = kind != seen.point_data.end() && kind->second[i] > 0.5;
    Vec3 at = seen.points[i];
    at.z() = height;
    (on_wall ? wall : skin).push_back(at);
  }
  if (!skin.empty()) panel.cloud(skin, dot_mm, shape_colours[2]);
  if (!wall.empty()) panel.cloud(wall, dot_mm, muscle_colour);
}

/// A line of a legend at height y; returns the height of the next one.
double add_name(Panel& panel, double y, const std::string& name, const Colour& colour) {
  constexpr double row = 24, left = 18;
  panel.line({left, y}, {left + 26, y}, colour, 4);
  panel.text({left + 34, y}, name, outline_letters - 1, palette::ink);
  return y - row;
}

void add_names(Panel& panel, const std::vector<std::pair<std::string, Colour>>& names) {
  double y = panel.size().y() - 62;
  for (const auto& [name, colour] : names) y = add_name(panel, y, name, colour);
}

}  // namespace

std::vector<Shape> shapes_of(const std::vector<const HexMesh*>& states) {
  std::vector<Shape> shapes{{states.front(), &states.front()->imaged, "as scanned"}};
  for (const HexMesh* mesh : states) {
    shapes.push_back({mesh, &mesh->points, posture_of(mesh->gravity)});
  }
  return shapes;
}

void add_silhouettes(Panel& panel, const std::vector<Shape>& shapes) {
  const Camera view = lateral_view(shapes.front().mesh->side);
  Vec3 depth = Vec3::Zero();
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const HexMesh& mesh = *shapes[k].mesh;
    Facets body = face_facets(mesh, *shapes[k].points, boundary_faces(mesh));
    if (k == 0) depth = body.points.front();
    panel.strokes(silhouette(body, view.direction, view.up, depth), colour_of(k), line_pixels);
  }
  panel.look_along(view.direction, view.up, 0.14);
  add_arrows(panel, shapes);
}

double add_shape_legend(Panel& panel, const std::vector<Shape>& shapes) {
  double y = panel.size().y() - 50;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    std::string words = shapes[k].name;
    for (const Landmark& landmark : shapes[k].mesh->landmarks) {
      if (k == 0 || !is_named(*shapes[k].mesh, landmark)) continue;
      std::string name = landmark.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      words += ", " + name + " moved " + format_fixed(moved_mm(shapes, k, landmark), 0) + " mm";
    }
    y = add_name(panel, y, words, colour_of(k));
  }
  return y;
}

void draw_postures(Picture& picture, const FigureInput& input) {
  need(input.meshes.size() == 1 && input.surfaces.size() == 1, "postures",
       "a deformed .vtkhdf and the .vtp of what was seen (identify --second and --seen)");
  const HexMesh& mesh = input.meshes.front().mesh;
  const Landmark* nipple = mesh.landmark("nipple");
  const double height = nipple != nullptr ? landmark_position(mesh, mesh.points, *nipple).z() : 0;
  Panel& slice = picture.panel(0, 0, 1, 1);
  add_section(slice, {&mesh, &mesh.imaged, ""}, height, shape_colours[0]);
  add_section(slice, {&mesh, &mesh.points, ""}, height, shape_colours[1]);
  add_wall(slice, mesh, height);
  add_seen(slice, input.surfaces.front(), height);
  add_arrows(slice, {{&mesh, &mesh.imaged, ""}, {&mesh, &mesh.points, ""}});
  slice.look_along(Vec3(0, 0, 1), Vec3(0, -1, 0), 0.16);
  slice.caption("transverse section through the nipple as predicted, seen from below");
  std::vector<std::pair<std::string, Colour>> names{
      {"as scanned prone; thin: end of the model", shape_colours[0]},
      {posture_of(mesh.gravity) + " as predicted", shape_colours[1]},
      {"skin as seen in the second scan", shape_colours[2]},
      {"front of the muscle as seen in the second scan", muscle_colour}};
  if (const std::string wall = wall_words(mesh); !wall.empty())
    names.emplace_back(wall, wall_colour);
  add_names(slice, names);
  slice.scale_bar();
  slice.compass();
}

void draw_outlines(Picture& picture, const FigureInput& input) {
  need(!input.meshes.empty(), "outlines", "a deformed .vtkhdf");
  std::vector<const HexMesh*> states;
  for (const auto& named : input.meshes) states.push_back(&named.mesh);
  const std::vector<Shape> shapes = shapes_of(states);
  const HexMesh& first = *states.front();
  const Landmark* nipple = first.landmark("nipple");
  const double height = nipple != nullptr ? landmark_position(first, first.imaged, *nipple).z() : 0;

  Panel& slice = picture.panel(0, 0, 0.5, 1);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    add_section(slice, shapes[k], height, colour_of(k));
  }
  add_wall(slice, first, height);
  slice.look_along(Vec3(0, 0, 1), Vec3(0, -1, 0), 0.16);
  add_arrows(slice, shapes);
  slice.caption("(a) transverse section through the nipple as scanned, seen from below");
  double below = add_shape_legend(slice, shapes);
  if (const std::string wall = wall_words(first); !wall.empty())
    below = add_name(slice, below, wall, wall_colour);
  slice.text({18, below}, "thin: where the model ends", outline_letters - 1, palette::ink);
  slice.scale_bar();
  slice.compass();

  Panel& body = picture.panel(0.5, 0, 1, 1);
  add_silhouettes(body, shapes);
  body.caption("(b) silhouettes from the outer side; lengths are in space");
  body.scale_bar();
  body.compass();
}

}  // namespace breast
