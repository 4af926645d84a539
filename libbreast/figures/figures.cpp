// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/figures.hpp"

#include <algorithm>
#include <functional>

#include "core/error.hpp"
#include "figures/parts.hpp"
#include "figures/private_display.hpp"

namespace breast {

namespace {

struct Figure {
  std::string name, summary;
  int width, height;
  bool geometry, points;  ///< what .vtkhdf and .vtp files are
  std::function<void(Picture&, const FigureInput&)> draw;

  /// Pixels; a single compression or mammogram needs half the room.
  std::pair<int, int> size(const FigureInput& input) const {
    const auto pressed =
        std::count_if(input.meshes.begin(), input.meshes.end(),
                      [](const auto& named) { return named.mesh.contact.has_value(); });
    if ((name == "compression" || name == "pressure") && pressed < 2) return {width, height / 2};
    if (name == "matching" && pressed < 2) return {2 * width / 3, height};
    if (name == "mammogram" && input.images.size() < 2) return {width / 2, height};
    return {width, height};
  }
};

const std::vector<Figure>& figures() {
  static const std::vector<Figure> list = {
      {"slices",
       "the scan in three planes with the contours of its segmentation (from --scan, --labels and "
       "a mesh .vtkhdf)",
       1800, 760, false, false, draw_slices},
      {"points", "the data points of skin and chest wall (from points .vtp of segment)", 1600, 800,
       false, true, draw_points},
      {"geometry",
       "the Hermite sheets with patch lines and rim (from a geometry .vtkhdf and optionally "
       "points .vtp)",
       1600, 800, true, true, draw_geometry},
      {"mesh", "the element edges of a mesh, front and back (from a mesh .vtkhdf)", 1600, 800,
       false, false, draw_mesh},
      {"tissues",
       "the fibroglandular region and the tumour through a translucent skin (from a "
       "mesh .vtkhdf)",
       1600, 800, false, false, draw_tissues},
      {"outlines",
       "the superimposed shapes of the scan and other postures (from one or more deformed "
       ".vtkhdf)",
       1600, 800, false, false, draw_outlines},
      {"postures",
       "one slice of a breast in the prone scan, as predicted in a second posture, and as "
       "observed there (from a deformed .vtkhdf and the .vtp of identify --seen)",
       1100, 900, false, true, draw_postures},
      {"compression", "the shapes between the plates (from one or two compressed .vtkhdf)", 1600,
       1060, false, false, draw_compression},
      {"pressure",
       "the contact pressure of paddle and detector on the skin (from one or two compressed "
       ".vtkhdf)",
       1600, 1300, false, false, draw_pressure},
      {"force-thickness",
       "the force of both plates during the compression (from a compressed "
       ".vtkhdf)",
       1600, 700, false, false, draw_force_thickness},
      {"mammogram",
       "the mammograms with axes in mm (from one or two .vti), optionally with curve, arc and "
       "tumour (from a curve .vtp)",
       1600, 1000, false, false, draw_mammogram},
      {"matching",
       "the column of a CC point in the CC, stress-free and MLO shapes (from cc.vtkhdf and "
       "mlo.vtkhdf or one of them, and a curve.vtp)",
       1800, 680, false, false, draw_matching},
      {"summary",
       "the whole chain (from mesh, reference, supine, cc and mlo .vtkhdf, cc.vti and mlo.vti, "
       "and optionally curve.vtp, --scan and --labels)",
       1500, 1050, false, false, draw_summary},
  };
  return list;
}

const Figure& figure(const std::string& name) {
  const auto found = std::find_if(figures().begin(), figures().end(),
                                  [&](const Figure& f) { return f.name == name; });
  if (found == figures().end()) throw input_error("unknown figure \"", name, "\"");
  return *found;
}

}  // namespace

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Figure& f : figures()) list.push_back(f.name);
    return list;
  }();
  return names;
}

std::string figure_summary(const std::string& name) {
  return figure(name).summary;
}
bool figure_takes_geometry(const std::string& name) {
  return figure(name).geometry;
}
bool figure_takes_points(const std::string& name) {
  return figure(name).points;
}

void draw_figure(const std::string& name, const FigureInput& input,
                 const std::filesystem::path& file) {
  const Figure& chosen = figure(name);
  const PrivateDisplay display;
  const auto [width, height] = chosen.size(input);
  Picture picture(width, height);
  chosen.draw(picture, input);
  picture.save(file);
}

}  // namespace breast
