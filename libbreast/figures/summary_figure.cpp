// SPDX-License-Identifier: GPL-3.0-or-later
// The whole chain on one picture.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "figures/parts.hpp"

namespace breast {

namespace {

constexpr BodyStyle body_style{.skin_opacity = 0.3, .inside = true, .gland_opacity = 0.85};

// The shapes, in any order, identified by the state recorded in their files.
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

constexpr double legend_height = 0.034, gap = 0.003;

/// Two planes of the scan at one scale, and below them the legend of their colours.
void add_scan(Picture& picture, const FigureInput& input, double bottom, double right) {
  const std::vector<SlicePlane> planes{SlicePlane::axial, SlicePlane::sagittal};
  const double axial = slice_size(input, planes[0]).x(),
               sagittal = slice_size(input, planes[1]).x();
  const double middle = right * axial / (axial + sagittal);
  const std::vector<Panel*> panels{
      &picture.panel(0, bottom + legend_height, middle - gap, 1),
      &picture.panel(middle, bottom + legend_height, right - gap, 1)};
  double scale = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    scale = std::max(
        scale, slice_size(input, planes[k]).cwiseQuotient(panels[k]->size()).maxCoeff());
  }
  for (std::size_t k = 0; k < 2; ++k) {
    add_slice(*panels[k], input, planes[k], scale, k == 0 ? "(a) " : "(b) ");
  }
  add_slice_legend(picture.panel(0, bottom, 1, bottom + legend_height), input, planes);
}

/// Without a scan: the tissues of the imaged body from two sides.
void add_tissues(Picture& picture, const HexMesh& mesh, double bottom, double right) {
  const std::string tumour = tumour_words(mesh);
  const std::string words = "fibroglandular (violet)" + (tumour.empty() ? "" : ", " + tumour);
  for (int k = 0; k < 2; ++k) {
    Panel& panel = picture.panel(0.5 * right * k, bottom, 0.5 * right * (k + 1), 1);
    add_body(panel, mesh, mesh.points, body_style);
    const Camera view = k == 0 ? lateral_view(mesh.side) : anterior_view();
    panel.look_along(view.direction, view.up);
    panel.caption(k == 0 ? "(a) as imaged: " + words : "(b) from the front");
    panel.scale_bar();
    panel.compass();
  }
}

void add_pressed(Panel& panel, const HexMesh& mesh, const PolyLines* curves,
                 const std::string& letter) {
  panel.draw_through(true);
  if (curves != nullptr) {
    for (const auto& line : named_lines(
             *curves, mesh.contact->view == View::cc ? "column in CC" : "column in MLO")) {
      panel.tube(line, 1.0, palette::column);
    }
  }
  panel.draw_through(false);
  add_body(panel, mesh, mesh.points, body_style);
  add_plates(panel, mesh, 0.4);
  add_image_border(panel, mesh);
  const Camera view = plate_view(mesh);
  panel.look_along(view.direction, view.up, 0.1);
  panel.caption(letter + compression_caption(mesh) + "; orange: image border");
  panel.scale_bar();
  panel.compass();
}

}  // namespace

void draw_summary(Picture& picture, const FigureInput& input) {
  const Chain chain = sort_meshes(input);
  need(chain.imaged && chain.reference && chain.supine && chain.cc && chain.mlo &&
           input.images.size() >= 2,
       "summary", "five meshes and two mammograms");
  const PolyLines* curves = input.curves ? &*input.curves : nullptr;
  constexpr double split = 0.48, scan_right = 0.63;
  if (input.scan && input.labels) {
    add_scan(picture, input, split, scan_right);
  } else {
    add_tissues(picture, *chain.imaged, split, scan_right);
  }
  Panel& postures = picture.panel(scan_right, split + legend_height, 1, 1);
  const std::vector<Shape> shapes = shapes_of({chain.reference, chain.supine});
  add_silhouettes(postures, shapes);
  postures.caption("(c) silhouettes from the outer side");
  add_shape_legend(postures, shapes);
  postures.scale_bar();
  postures.compass();
  add_pressed(picture.panel(0, 0, 0.25, split), *chain.cc, curves, "(d) ");
  add_pressed(picture.panel(0.25, 0, 0.5, split), *chain.mlo, curves, "(e) ");
  for (std::size_t k = 0; k < 2; ++k) {
    Panel& panel = picture.panel(0.5 + 0.25 * double(k), 0, 0.75 + 0.25 * double(k), split);
    add_mammogram(panel, input.images[k], curves, k == 0 ? "(f) " : "(g) ");
  }
}

}  // namespace breast
