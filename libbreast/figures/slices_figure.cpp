// SPDX-License-Identifier: GPL-3.0-or-later
// The scan in three planes with the contours of its segmentation: what the model was made from.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "figures/parts.hpp"
#include "figures/shapes/plane_section.hpp"
#include "figures/shapes/slice_view.hpp"
#include "mesh/landmark_names.hpp"

namespace breast {

namespace {

constexpr Colour skin_line{0.25, 0.85, 0.95}, wall_line{0.30, 0.95, 0.35},
    gland_line{1.0, 0.45, 0.80}, model_line{1.0, 0.62, 0.25}, dim{0.65, 0.65, 0.65};
constexpr double margin_mm = 12, line_width = 1.5, slice_letters = 15;
/// A landmark farther from the plane than this is not marked in it, mm.
constexpr double in_plane_mm = 6;

struct PlaneWords {
  const char *name, *left, *right, *top, *bottom, *axis;
};
PlaneWords words_of(SlicePlane plane) {
  if (plane == SlicePlane::axial) return {"axial", "R", "L", "A", "P", "z"};
  if (plane == SlicePlane::sagittal) return {"sagittal", "A", "P", "S", "I", "x"};
  return {"coronal", "R", "L", "S", "I", "y"};
}
int axis_of(SlicePlane plane) {
  return plane == SlicePlane::axial ? 2 : plane == SlicePlane::sagittal ? 0 : 1;
}

const HexMesh* model_of(const FigureInput& input) {
  return input.meshes.empty() ? nullptr : &input.meshes.front().mesh;
}

/// The position of the tumour in the scan; taken from the labels if there is no mesh.
const Vec3* tumour_of(const FigureInput& input) {
  if (const HexMesh* mesh = model_of(input)) {
    const Landmark* landmark = mesh->landmark("tumour");
    return landmark != nullptr ? &landmark->imaged : nullptr;
  }
  const auto found = input.labels->landmarks.find("tumour");
  return found != input.labels->landmarks.end() ? &found->second : nullptr;
}

/// The nipple if it lies in the slice or near it.
const Vec3* nipple_in(const FigureInput& input, SlicePlane plane) {
  const auto found = input.labels->landmarks.find("nipple");
  if (found == input.labels->landmarks.end()) return nullptr;
  const int axis = axis_of(plane);
  const double beside = std::abs(found->second[axis] - slices_through(input)[axis]);
  return beside < in_plane_mm ? &found->second : nullptr;
}

/// Three-dimensional positions for drawing a slice: mm in the frame, a little above the image.
Vec3 lifted(const Vec2& mm) {
  return {mm.x(), mm.y(), 1};
}

void add_lines(Panel& panel, const std::vector<PlaneSegment>& lines, const Colour& colour) {
  std::vector<std::array<Vec3, 2>> pieces;
  for (const auto& [a, b] : lines) pieces.push_back({lifted(a), lifted(b)});
  panel.strokes(pieces, colour, line_width);
}

/// The end of the model's body: its cut surface in this plane.
std::vector<PlaneSegment> model_end(const HexMesh& mesh, const SliceFrame& frame) {
  const Vec3 normal = frame.right.cross(frame.up);
  std::vector<PlaneSegment> lines;
  for (const auto& [a, b] : plane_section(face_facets(mesh, mesh.imaged, mesh.cut_faces), normal,
                                          frame.corner.dot(normal))) {
    lines.push_back({frame.flat(a), frame.flat(b)});
  }
  return lines;
}

void add_letters(Panel& panel, SlicePlane plane) {
  const PlaneWords words = words_of(plane);
  const Vec2 size = panel.size();
  panel.text({12, 0.5 * size.y()}, words.left, slice_letters + 3, white);
  panel.text({size.x() - 12, 0.5 * size.y()}, words.right, slice_letters + 3, white, Align::right);
  panel.text({0.5 * size.x(), size.y() - 36}, words.top, slice_letters + 3, white, Align::centre);
  panel.text({0.5 * size.x(), 16}, words.bottom, slice_letters + 3, white, Align::centre);
}

/// Ticks at the borders, where the two other planes intersect this one.
void add_ticks(Panel& panel, const SliceFrame& frame, const Vec3& through) {
  const Vec2 size = panel.size(), at = panel.to_pixel(lifted(frame.flat(through)));
  constexpr double length = 12;
  for (const double y : {0.0, size.y() - length}) {
    panel.line({at.x(), y}, {at.x(), y + length}, dim, 1.5);
  }
  for (const double x : {0.0, size.x() - length}) {
    panel.line({x, at.y()}, {x + length, at.y()}, dim, 1.5);
  }
}

}  // namespace

Vec3 slices_through(const FigureInput& input) {
  const Vec3* tumour = tumour_of(input);
  return tumour != nullptr ? *tumour : breast_centre(*input.labels);
}

Vec2 slice_size(const FigureInput& input, SlicePlane plane) {
  const ShownBox box = breast_box(*input.labels, margin_mm);
  const Vec3 size = box.high - box.low;
  return {plane == SlicePlane::sagittal ? size.y() : size.x(),
          plane == SlicePlane::axial ? size.y() : size.z()};
}

void add_slice(Panel& panel, const FigureInput& input, SlicePlane plane, double mm_per_pixel,
               const std::string& letter) {
  const ShownBox box = breast_box(*input.labels, margin_mm);
  const Vec3 through = slices_through(input);
  Vec3 centre = box.centre();
  centre[axis_of(plane)] = through[axis_of(plane)];
  // The image fills the panel.
  const SliceFrame frame(plane, centre, mm_per_pixel * (panel.size() + Vec2(2, 2)));
  const double pixel = 0.75 * mm_per_pixel;
  const SliceImage image =
      slice_image(*input.scan, frame, pixel, white_level(*input.scan, *input.labels));
  panel.image(image.grey, image.width, image.height, pixel);
  const SliceContours contours = slice_contours(*input.labels, frame);
  if (const HexMesh* mesh = model_of(input)) add_lines(panel, model_end(*mesh, frame), model_line);
  add_lines(panel, contours.gland, gland_line);
  add_lines(panel, contours.wall, wall_line);
  add_lines(panel, contours.skin, skin_line);
  panel.look_along({0, 0, -1}, {0, 1, 0}, {0.5 * frame.width, 0.5 * frame.height, 0},
                   mm_per_pixel * panel.size().y());
  if (const Vec3* tumour = tumour_of(input)) {
    panel.ring(lifted(frame.flat(*tumour)), point_ring_pixels, palette::tumour);
  }
  if (const Vec3* nipple = nipple_in(input, plane)) {
    panel.ring(lifted(frame.flat(*nipple)), 0.7 * point_ring_pixels, white);
  }
  add_letters(panel, plane);
  add_ticks(panel, frame, through);
  const PlaneWords words = words_of(plane);
  panel.text({10, panel.size().y() - 16},
             letter + words.name + ", " + words.axis + " = " +
                 format_fixed(through[axis_of(plane)], 0) + " mm",
             slice_letters + 1, white);
  panel.scale_bar(white);
}

void add_slice_legend(Panel& panel, const FigureInput& input,
                      const std::vector<SlicePlane>& planes) {
  const double y = 0.5 * panel.size().y();
  double x = 14;
  const auto words = [&](const std::string& text) {
    panel.text({x, y}, text, slice_letters, palette::ink);
    x += 8.2 * double(text.size()) + 26;
  };
  const auto entry = [&](const std::string& text, const Colour& colour) {
    panel.line({x, y}, {x + 26, y}, black, 5);
    panel.line({x + 1, y}, {x + 25, y}, colour, 3);
    x += 34;
    words(text);
  };
  entry("skin", skin_line);
  entry("chest wall", wall_line);
  entry("fibroglandular tissue", gland_line);
  const HexMesh* mesh = model_of(input);
  if (mesh != nullptr) entry("end of the model", model_line);
  if (tumour_of(input) == nullptr) {
    words("through the middle of the fibroglandular tissue");
  } else {
    const bool artificial = mesh != nullptr && tumour_words(*mesh).starts_with("artificial");
    words(artificial ? "yellow ring: artificial tumour (not in the scan)" : "yellow ring: tumour");
  }
  if (std::any_of(planes.begin(), planes.end(),
                  [&](SlicePlane plane) { return nipple_in(input, plane) != nullptr; })) {
    words("white ring: nipple");
  }
}

void need_scan(const FigureInput& input, const std::string& figure) {
  need(input.scan.has_value() && input.labels.has_value(), figure,
       "the scan (--scan) and its labels (--labels)");
}

void draw_slices(Picture& picture, const FigureInput& input) {
  need_scan(input, "slices");
  constexpr double legend = 0.07, gap = 0.003;
  const std::vector<SlicePlane> planes{SlicePlane::axial, SlicePlane::sagittal,
                                       SlicePlane::coronal};
  double across = 0;
  for (const SlicePlane plane : planes) across += slice_size(input, plane).x();
  // One scale for all: the width of a panel is that of its content.
  std::vector<Panel*> panels;
  double left = 0, scale = 0;
  for (const SlicePlane plane : planes) {
    const Vec2 size = slice_size(input, plane);
    const double right = left + size.x() / across;
    panels.push_back(&picture.panel(left, legend, plane == planes.back() ? 1 : right - gap, 1));
    scale = std::max(scale, size.cwiseQuotient(panels.back()->size()).maxCoeff());
    left = right;
  }
  char letter = 'a';
  for (std::size_t k = 0; k < planes.size(); ++k) {
    add_slice(*panels[k], input, planes[k], scale, {'(', letter++, ')', ' '});
  }
  add_slice_legend(picture.panel(0, 0, 1, legend), input, planes);
}

}  // namespace breast
