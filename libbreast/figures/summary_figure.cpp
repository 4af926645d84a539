// SPDX-License-Identifier: GPL-3.0-or-later
// The whole chain on one picture.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "figures/parts.hpp"

namespace breast {

namespace {

// Pixels of the picture as figures.cpp declares it: the panels' shape follows.
constexpr double summary_width = 2000, summary_height = 1250;

// The shapes by what their files say of themselves, in any order.
struct Chain {
  const HexMesh *imaged = nullptr, *reference = nullptr, *supine = nullptr, *cc = nullptr,
                *mlo = nullptr;
};

Chain sort_meshes(const FigureInput& input) {
  Chain chain;
  for (const auto& named : input.meshes) {
    const HexMesh& mesh = named.mesh;
    if (mesh.contact) {
      (mesh.contact->view == View::cc ? chain.cc : chain.mlo) = &mesh;
    } else if (mesh.reference.empty()) {
      chain.imaged = &mesh;
    } else if (mesh.gravity.norm() == 0) {
      chain.reference = &mesh;
    } else {
      chain.supine = &mesh;
    }
  }
  return chain;
}

// Extent of a point set along a direction, mm.
double extent(const std::vector<Vec3>& points, const Vec3& along) {
  double low = 1e300, high = -1e300;
  for (const Vec3& x : points) {
    low = std::min(low, x.dot(along));
    high = std::max(high, x.dot(along));
  }
  return high - low;
}

// Height of the view that shows all shapes at one scale in panels of the given width over height.
double common_height(const Chain& chain, const Camera& view, double aspect) {
  const Vec3 across = view.direction.cross(view.up).normalized();
  double height = 1;
  for (const HexMesh* mesh : {chain.imaged, chain.reference, chain.supine}) {
    height = std::max({height, extent(mesh->points, view.up) / 0.72,
                       extent(mesh->points, across) / (0.9 * aspect)});
  }
  return height;
}

Vec3 middle_of(const HexMesh& mesh) {
  Vec3 low = mesh.points.front(), high = low;
  for (const Vec3& x : mesh.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return 0.5 * (low + high);
}

}  // namespace

void draw_summary(Picture& picture, const FigureInput& input) {
  const Chain chain = sort_meshes(input);
  need(chain.imaged && chain.reference && chain.supine && chain.cc && chain.mlo &&
           input.images.size() >= 2,
       "summary", "five meshes and two mammograms");
  const PolyLines* curves = input.curves ? &*input.curves : nullptr;
  const bool artificial = tumour_words(*chain.imaged).starts_with("artificial");
  const Camera side = lateral_view(chain.imaged->side);
  const double split = 0.54;
  const double aspect = 0.2 * summary_width / ((1 - split) * summary_height);
  const double height = common_height(chain, side, aspect);
  struct Shape {
    const HexMesh* mesh;
    std::string caption;
  };
  const std::vector<Shape> shapes = {
      {chain.imaged, artificial ? "(a) prone, artificial tumour" : "(a) as imaged, prone"},
                                     {chain.reference, "(b) stress-free"},
                                     {chain.supine, "(c) supine"}};
  const BodyStyle style{.skin_opacity = 0.3, .inside = true, .gland_opacity = 0.7};
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    Panel& panel = picture.panel(0.2 * double(k), split, 0.2 * double(k + 1), 1);
    add_body(panel, *shapes[k].mesh, shapes[k].mesh->points, style);
    panel.look_along(side.direction, side.up, middle_of(*shapes[k].mesh), height);
    panel.caption(shapes[k].caption);
    panel.scale_bar();
    panel.compass();
  }
  const std::vector<Shape> pressed = {{chain.cc, "(d) "}, {chain.mlo, "(e) "}};
  for (std::size_t k = 0; k < pressed.size(); ++k) {
    Panel& panel = picture.panel(0.6 + 0.2 * double(k), split, 0.8 + 0.2 * double(k), 1);
    add_body(panel, *pressed[k].mesh, pressed[k].mesh->points, style);
    add_plates(panel, *pressed[k].mesh, 0.4);
    if (curves != nullptr) {
      for (const auto& line : named_lines(*curves, k == 0 ? "column in CC" : "column in MLO")) {
        panel.tube(line, 1.2, palette::column);
      }
    }
    const Camera view = plate_view(*pressed[k].mesh);
    panel.look_along(view.direction, view.up, 0.1);
    panel.caption(pressed[k].caption + compression_caption(*pressed[k].mesh));
    panel.scale_bar();
    panel.compass();
  }
  for (std::size_t k = 0; k < 2; ++k) {
    Panel& panel = picture.panel(0.5 * double(k), 0, 0.5 * double(k + 1), split);
    add_mammogram(panel, input.images[k], curves, k == 0 ? "(f) " : "(g) ");
  }
}

}  // namespace breast
