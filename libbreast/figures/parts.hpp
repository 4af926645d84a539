// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing functions that the figures share: colours, views, a breast, its mammogram.
#pragma once

#include "figures/body_surfaces.hpp"
#include "figures/canvas.hpp"
#include "figures/figures.hpp"
#include "figures/shapes/slice_view.hpp"

namespace breast::palette {

inline constexpr Colour skin{0.93, 0.74, 0.63};
inline constexpr Colour muscle{0.42, 0.15, 0.13};
inline constexpr Colour cut{0.72, 0.52, 0.45};
inline constexpr Colour gland{0.62, 0.36, 0.56};
inline constexpr Colour tumour{1.0, 0.82, 0.05};
inline constexpr Colour column{0.0, 0.62, 0.35};
inline constexpr Colour arc{0.20, 0.55, 1.0};
inline constexpr Colour plate{0.55, 0.68, 0.80};
inline constexpr Colour image_border{0.95, 0.50, 0.05};
inline constexpr Colour ink{0, 0, 0};

}  // namespace breast::palette

namespace breast {

/// Radius of a cloud's points.
inline constexpr double dot_mm = 0.7;
/// Radius of the ring round the point that the figure is about.
inline constexpr double point_ring_pixels = 13;

/// Viewing direction and upward direction, in the patient frame.
struct Camera {
  Vec3 direction, up;
};
Camera lateral_view(Side side);  ///< from the body's outer side
Camera anterior_view();          ///< from the front
Camera oblique_view(Side side);  ///< from front, lateral and above
/// The view along the edges of the plates, with the paddle on top, which shows both plates edge-on.
Camera plate_view(const HexMesh& mesh);

struct BodyStyle {
  double skin_opacity = 1;
  bool edges = false;
  bool inside = false;  ///< fibroglandular region and tumour
  double gland_opacity = 1;
  bool back = true;  ///< chest wall and cut
};
void add_body(Panel& panel, const HexMesh& mesh, const std::vector<Vec3>& nodal,
              const BodyStyle& style);
/// Both plates of the mesh's compression, long enough for the body.
void add_plates(Panel& panel, const HexMesh& mesh, double opacity);
/// The border of the mammogram on the detector, visible through the body, in the pose of the
/// projection's parallel beam. The image ends at its posterior side.
void add_image_border(Panel& panel, const HexMesh& mesh);
/// Draws a landmark of the mesh as a sphere; nothing if there is none of that name.
void add_landmark(Panel& panel, const HexMesh& mesh, const std::vector<Vec3>& nodal,
                  const std::string& name, double radius, const Colour& colour);
/// "tumour (yellow)", "artificial tumour (yellow)", or an empty text for a mesh without a tumour.
std::string tumour_words(const HexMesh& mesh);
/// A caption such as "MLO (left), 46.2 mm, 91 / 93 N" for a compressed mesh, with the forces of
/// paddle and detector.
std::string compression_caption(const HexMesh& mesh);

/// Draws a mammogram in clinical orientation with axes in mm, and over it the curves of `curves`
/// (may be null) for its view. `letter` begins the caption.
void add_mammogram(Panel& panel, const Mammogram& image, const PolyLines* curves,
                   const std::string& letter);
/// The parts of a line inside an image of `size` mm; `outside_mm` receives the length of the rest
/// in mm.
std::vector<std::vector<Vec2>> parts_inside(const std::vector<Vec2>& line, const Vec2& size,
                                            double* outside_mm);
/// The points of all lines with that name.
std::vector<std::vector<Vec3>> named_lines(const PolyLines& lines, const std::string& name);

/// Throws Error (input) naming the figure if fewer files were given.
void need(bool given, const std::string& figure, const std::string& what);

/// Throws Error (input) if scan and labels are not given.
void need_scan(const FigureInput& input, const std::string& figure);
/// The point in which all three slices intersect: the tumour, or the centre of the fibroglandular
/// tissue.
Vec3 slices_through(const FigureInput& input);
/// Width and height in mm of the slice that shows the whole breast.
Vec2 slice_size(const FigureInput& input, SlicePlane plane);
/// Draws the slice of the scan with contours, marks, orientation letters and scale bar, filling the
/// panel.
void add_slice(Panel& panel, const FigureInput& input, SlicePlane plane, double mm_per_pixel,
               const std::string& letter);
/// Draws one row with the legend of the slices' colours.
void add_slice_legend(Panel& panel, const FigureInput& input,
                      const std::vector<SlicePlane>& planes);

/// Overlaid shapes of one breast: that of the scan, then those of the states.
struct Shape {
  const HexMesh* mesh;
  const std::vector<Vec3>* points;
  std::string name;
};
std::vector<Shape> shapes_of(const std::vector<const HexMesh*>& states);
/// Draws their silhouettes from the lateral side, with an arrow from each landmark's position in
/// the scan to that in the last shape, and the distance in mm.
void add_silhouettes(Panel& panel, const std::vector<Shape>& shapes);
/// Draws one line per shape with its colour, its name and the displacements of its landmarks. Returns the
/// height of the line below.
double add_shape_legend(Panel& panel, const std::vector<Shape>& shapes);

void draw_slices(Picture& picture, const FigureInput& input);
void draw_points(Picture& picture, const FigureInput& input);
void draw_geometry(Picture& picture, const FigureInput& input);
void draw_mesh(Picture& picture, const FigureInput& input);
void draw_tissues(Picture& picture, const FigureInput& input);
void draw_outlines(Picture& picture, const FigureInput& input);
void draw_postures(Picture& picture, const FigureInput& input);
void draw_compression(Picture& picture, const FigureInput& input);
void draw_pressure(Picture& picture, const FigureInput& input);
void draw_force_thickness(Picture& picture, const FigureInput& input);
void draw_mammogram(Picture& picture, const FigureInput& input);
void draw_matching(Picture& picture, const FigureInput& input);
void draw_summary(Picture& picture, const FigureInput& input);

}  // namespace breast
