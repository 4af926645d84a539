// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of one breast over each other: where its tissue goes from the scan to another posture.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/table.hpp"
#include "figures/parts.hpp"

namespace breast {

namespace {

constexpr std::array<Colour, 4> colours = {
    {{0.15, 0.35, 0.70}, {0.85, 0.40, 0.10}, {0.20, 0.55, 0.30}, {0.55, 0.30, 0.60}}};
constexpr Colour wall_colour{0.35, 0.20, 0.18};
constexpr double line_mm = 0.7, thin_mm = 0.35, dot_mm = 2;

/// One shape of the breast: the scan's, or that of a state.
struct Shape {
  const HexMesh* mesh;
  const std::vector<Vec3>* points;
  std::string name;
};

std::string posture_of(const Vec3& gravity) {
  if (gravity.norm() == 0) return "without gravity";
  if (-gravity.y() > 0.9 * gravity.norm()) return "prone";
  if (gravity.y() > 0.9 * gravity.norm()) return "supine";
  return "under gravity " + format_fixed(gravity.x(), 0) + ", " + format_fixed(gravity.y(), 0) +
         ", " + format_fixed(gravity.z(), 0) + " mm/s2";
}

/// Where the plane z = height cuts the facets: pairs of points.
std::vector<std::array<Vec3, 2>> section(const Facets& facets, double height) {
  std::vector<std::array<Vec3, 2>> segments;
  const auto cut = [&](int i, int j, int k) {
    std::vector<Vec3> ends;
    const std::array<int, 3> corner{i, j, k};
    for (int c = 0; c < 3; ++c) {
      const Vec3 &a = facets.points[std::size_t(corner[c])],
                 &b = facets.points[std::size_t(corner[(c + 1) % 3])];
      if ((a.z() > height) == (b.z() > height)) continue;
      ends.push_back(a + (height - a.z()) / (b.z() - a.z()) * (b - a));
    }
    if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
  };
  for (const auto& quad : facets.quads) {
    cut(quad[0], quad[1], quad[2]);
    if (quad[3] != quad[2]) cut(quad[0], quad[2], quad[3]);
  }
  return segments;
}

void add_section(Panel& panel, const Shape& shape, double height, const Colour& colour) {
  const auto add = [&](const std::vector<Face>& faces, double radius) {
    for (const auto& [a, b] : section(face_facets(*shape.mesh, *shape.points, faces), height)) {
      panel.tube({a, b}, radius, colour);
    }
  };
  add(shape.mesh->skin_faces, line_mm);
  add(shape.mesh->pectoral_faces, line_mm);
  add(shape.mesh->cut_faces, thin_mm);
}

/// Lines of the wall surface at some heights about the middle one, mm.
void add_wall(Panel& panel, const HexMesh& mesh, double height, const std::vector<double>& offsets) {
  if (!mesh.geometry || !mesh.geometry->thorax) return;
  const ThoraxSurface& thorax = *mesh.geometry->thorax;
  for (const double offset : offsets) {
    const double above = height + offset - thorax.origin.z();
    if (!(above >= thorax.height_low && above <= thorax.height_high)) continue;
    std::vector<Vec3> line;
    constexpr int steps = 120;
    for (int i = 0; i <= steps; ++i) {
      const double angle =
          thorax.angle_low + (thorax.angle_high - thorax.angle_low) * i / steps;
      line.push_back(thorax.point(angle, above));
    }
    panel.tube(line, thin_mm, wall_colour);
  }
}

/// The landmark's places in all shapes, joined.
void add_track(Panel& panel, const std::vector<Shape>& shapes, const Landmark& landmark) {
  std::vector<Vec3> places;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    places.push_back(landmark_position(*shapes[k].mesh, *shapes[k].points, landmark));
    panel.sphere(places.back(), dot_mm, colours[k % colours.size()]);
    if (k > 0) panel.tube({places.front(), places.back()}, thin_mm, palette::ink);
  }
}

void add_legend(Panel& panel, const std::vector<Shape>& shapes) {
  constexpr double row = 24, text_height = 17, left = 18;
  double y = panel.size().y() - 62;
  for (std::size_t k = 0; k < shapes.size(); ++k, y -= row) {
    std::string words = shapes[k].name;
    for (const Landmark& landmark : shapes[k].mesh->landmarks) {
      if (k == 0) continue;
      const Vec3 moved = landmark_position(*shapes[k].mesh, *shapes[k].points, landmark) -
                         landmark_position(*shapes[0].mesh, *shapes[0].points, landmark);
      std::string name = landmark.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      words += ", " + name + " moved " + format_fixed(moved.norm(), 0) + " mm";
    }
    const Colour& colour = colours[k % colours.size()];
    panel.line({left, y + 6}, {left + 26, y + 6}, colour, 4);
    panel.text({left + 34, y}, words, text_height, palette::ink);
  }
}

}  // namespace

void draw_outlines(Picture& picture, const FigureInput& input) {
  need(!input.meshes.empty(), "outlines", "a deformed .vtkhdf");
  const HexMesh& first = input.meshes.front().mesh;
  std::vector<Shape> shapes{{&first, &first.imaged, "as scanned"}};
  for (const auto& named : input.meshes) {
    shapes.push_back({&named.mesh, &named.mesh.points, posture_of(named.mesh.gravity)});
  }
  const Landmark* nipple = first.landmark("nipple");
  const double height =
      nipple != nullptr ? landmark_position(first, first.imaged, *nipple).z() : 0;

  Panel& slice = picture.panel(0, 0, 0.5, 1);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    add_section(slice, shapes[k], height, colours[k % colours.size()]);
  }
  add_wall(slice, first, height, {0});
  slice.look_along(Vec3(0, 0, 1), Vec3(0, -1, 0), 0.16);
  slice.caption("(a) transverse section through the nipple as scanned, seen from below");
  add_legend(slice, shapes);
  slice.scale_bar();
  slice.compass();

  Panel& body = picture.panel(0.5, 0, 1, 1);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const bool last = k + 1 == shapes.size();
    body.surface(face_facets(*shapes[k].mesh, *shapes[k].points, shapes[k].mesh->skin_faces),
                 {.colour = colours[k % colours.size()], .opacity = last ? 0.85 : 0.3});
  }
  std::vector<double> offsets;
  for (double offset = -120; offset <= 120; offset += 20) offsets.push_back(offset);
  add_wall(body, first, height, offsets);
  for (const Landmark& landmark : first.landmarks) add_track(body, shapes, landmark);
  const Camera view = oblique_view(first.side);
  body.look_along(view.direction, view.up, 0.12);
  body.caption("(b) skin and landmarks on the wall surface (lines every 20 mm)");
  body.scale_bar();
  body.compass();
}

}  // namespace breast
