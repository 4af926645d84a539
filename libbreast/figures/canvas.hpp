// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of several panels with parallel projection, so that a millimetre has the same length
// everywhere in a panel. Hides VTK.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct Colour {
  double r = 0, g = 0, b = 0;
};
inline constexpr Colour black{0, 0, 0}, white{1, 1, 1};

/// Quadrilaterals (triangles repeat their last corner).
struct Facets {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> quads;
  /// At the points, for shading; if empty, they are computed from the facets.
  std::vector<Vec3> normals;
};

struct Look {
  Colour colour{0.8, 0.8, 0.8};
  double opacity = 1;
  bool smooth = true;  ///< shading across facets that meet below 50°
  bool edges = false;  ///< draw the facets' edges
  Colour edge_colour{0.15, 0.15, 0.15};
  double shine = 0.15;
};

enum class Align { left, centre, right };

/// One view. Add objects first, then choose the camera, then add overlays (in pixels from the
/// panel's lower left corner, before supersampling).
class Panel {
 public:
  struct Impl;
  explicit Panel(std::unique_ptr<Impl> impl);
  ~Panel();

  /// Everything added after this call is drawn over everything else, whatever its depth: for marks
  /// that must be visible through the body.
  void draw_through(bool on);
  void surface(const Facets& facets, const Look& look);
  /// Draws facets with colours that represent a value at each point, from 0 to `high`
  /// (figures/colour_scale.hpp).
  void values(const Facets& facets, const std::vector<double>& at_points, double high);
  void sphere(const Vec3& centre, double radius, const Colour& colour);
  void cloud(const std::vector<Vec3>& points, double radius, const Colour& colour);
  void tube(const std::vector<Vec3>& points, double radius, const Colour& colour);
  /// Draws a grey image in the plane z = 0: rows from the top, the lower left pixel centred at
  /// (0,0), pixels of `pixel` mm.
  void image(const std::vector<std::uint16_t>& grey, int width, int height, double pixel);
  /// Draws a line on an image (z slightly above 0), `width` in pixels.
  void stroke(const std::vector<Vec3>& points, const Colour& colour, double width);
  /// Adds many short line segments at once; like surfaces, they count for the extent of the
  /// picture.
  void strokes(const std::vector<std::array<Vec3, 2>>& pieces, const Colour& colour, double width);

  /// Looks along `direction` with `up` on top, such that everything added so far is visible;
  /// `margin` is the fraction of the panel left free around it.
  void look_along(const Vec3& direction, const Vec3& up, double margin = 0.12);
  /// The same with the given centre and height of the view in mm.
  void look_along(const Vec3& direction, const Vec3& up, const Vec3& centre, double height_mm);
  double height_mm() const;  ///< of the view
  void set_height_mm(double height);
  double mm_per_pixel() const;
  Vec2 to_pixel(const Vec3& x) const;
  Vec2 size() const;  ///< pixels

  void text(const Vec2& at, const std::string& words, double height, const Colour& colour,
            Align align = Align::left);
  /// Adds text on a light background, legible over a drawing.
  void label(const Vec2& at, const std::string& words, double height, const Colour& colour,
             Align align = Align::left);
  void line(const Vec2& from, const Vec2& to, const Colour& colour, double width);
  void path(const std::vector<Vec2>& points, const Colour& colour, double width);
  /// Adds a ring around a position, with a dark rim; `radius` in pixels.
  void ring(const Vec3& at, double radius, const Colour& colour);
  /// Adds an arrow between two positions in the plane of the picture.
  void arrow(const Vec3& from, const Vec3& to, const Colour& colour);
  /// Adds text at the top left, in as many lines as the width of the panel requires; returns their
  /// number.
  int caption(const std::string& words);
  /// At the bottom right, with a round number of mm.
  void scale_bar(const Colour& colour = {0, 0, 0});
  void compass();  ///< bottom left: left, anterior, superior

 private:
  std::unique_ptr<Impl> impl_;
};

class Picture {
 public:
  Picture(int width, int height);
  ~Picture();
  /// Panel covering this part of the picture, fractions from the lower left corner.
  Panel& panel(double left, double bottom, double right, double top);
  /// Renders and writes an RGB PNG atomically. Needs a display (PrivateDisplay).
  void save(const std::filesystem::path& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace breast
