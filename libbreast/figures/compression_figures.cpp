// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes between plates (Fig. 5) and the column that a CC pixel is (Fig. 7).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "figures/parts.hpp"
#include "mesh/compressed_pose.hpp"
#include "mesh/plate_edge.hpp"

namespace breast {

namespace {

// The first mesh compressed in CC, or in another view; null when there is none.
const HexMesh* compressed(const FigureInput& input, bool cc) {
  for (const auto& named : input.meshes) {
    if (named.mesh.contact && (named.mesh.contact->view == View::cc) == cc) return &named.mesh;
  }
  return nullptr;
}

// The stress-free shape with both plates drawn back until they just touch it.
HexMesh before_compression(const HexMesh& mesh) {
  HexMesh before = mesh;
  before.points = mesh.reference.empty() ? mesh.imaged : mesh.reference;
  for (PlateRecord& plate : before.contact->plates) {
    double back = 0;
    for (const Vec3& x : before.points) {
      const Vec3 d = x - plate.origin;
      const double rounding = edge_recession(plate.edge_radius, -d.dot(plate.anterior));
      back = std::max(back, -d.dot(plate.normal) - rounding);
    }
    plate.origin -= back * plate.normal;
  }
  return before;
}

struct Sight {
  Panel& panel;
  Camera view;
  std::string caption;
};

// All have the same scale, that of the largest.
void finish(const std::vector<Sight>& sights) {
  double height = 0;
  for (const Sight& sight : sights) {
    sight.panel.look_along(sight.view.direction, sight.view.up, 0.08);
    height = std::max(height, sight.panel.height_mm());
  }
  for (const Sight& sight : sights) {
    sight.panel.set_height_mm(height);
    sight.panel.caption(sight.caption);
    sight.panel.scale_bar();
    sight.panel.compass();
  }
}

void compression_row(Picture& picture, const HexMesh& mesh, double bottom, double top,
                     char letter) {
  const auto name = [&](int k) { return "(" + std::string(1, char(letter + k)) + ") "; };
  const Camera view = plate_view(mesh);
  const HexMesh before = before_compression(mesh);
  Panel& left = picture.panel(0, bottom, 1.0 / 3, top);
  add_body(left, before, before.points, {});
  add_plates(left, before, 0.45);
  Panel& middle = picture.panel(1.0 / 3, bottom, 2.0 / 3, top);
  add_body(middle, mesh, mesh.points, {});
  add_plates(middle, mesh, 0.45);
  add_image_border(middle, mesh);
  Panel& right = picture.panel(2.0 / 3, bottom, 1, top);
  add_body(right, mesh, mesh.points, {.edges = true});
  add_plates(right, mesh, 0.25);
  add_image_border(right, mesh);
  const ViewPose pose = compressed_pose(mesh);
  finish({{left, view, name(0) + "stress-free, plates touching"},
          {middle, view, name(1) + compression_caption(mesh)},
          {right,
           {-pose.e_u + 0.35 * view.direction + 0.3 * pose.n, -pose.n},
           name(2) + "from the front; orange: border of the image"}});
}

void add_columns(Panel& panel, const PolyLines& curves, const std::string& name) {
  panel.draw_through(true);
  for (const auto& line : named_lines(curves, name)) panel.tube(line, 1.0, palette::column);
  panel.draw_through(false);
}

}  // namespace

void draw_compression(Picture& picture, const FigureInput& input) {
  std::vector<const HexMesh*> meshes;
  for (const auto& named : input.meshes) {
    if (named.mesh.contact) meshes.push_back(&named.mesh);
  }
  need(!meshes.empty(), "compression", "a compressed .vtkhdf");
  const std::size_t rows = std::min<std::size_t>(meshes.size(), 2);
  for (std::size_t r = 0; r < rows; ++r) {
    const double top = 1 - double(r) / double(rows), bottom = top - 1 / double(rows);
    compression_row(picture, *meshes[r], bottom, top, char('a' + 3 * r));
  }
}

void draw_matching(Picture& picture, const FigureInput& input) {
  need(input.curves.has_value(), "matching", "a curve .vtp");
  const HexMesh *cc = compressed(input, true), *mlo = compressed(input, false);
  need(cc != nullptr || mlo != nullptr, "matching", "a compressed .vtkhdf");
  const HexMesh& any = cc != nullptr ? *cc : *mlo;
  const BodyStyle style{.skin_opacity = 0.22, .inside = true, .gland_opacity = 0.7};
  struct Posture {
    const HexMesh& mesh;
    const std::vector<Vec3>& points;
    std::string line, caption;
    Camera view;
  };
  const Camera side = lateral_view(any.side);
  std::vector<Posture> shapes;
  if (cc != nullptr) {
    const std::string tumour = tumour_words(*cc);
    shapes.push_back(
        {*cc, cc->points, "column in CC",
         "CC: tissue above the pixel (green)" + (tumour.empty() ? "" : ", " + tumour),
         plate_view(*cc)});
  }
  shapes.push_back({any,
                    any.reference.empty() ? any.imaged : any.reference,
                    any.reference.empty() ? "column in imaged" : "column in reference",
                    "the same tissue, stress-free",
                    {side.direction + Vec3(0, 0.35, -0.22), side.up}});
  if (mlo != nullptr) {
    shapes.push_back({*mlo, mlo->points, "column in MLO",
                      "the same tissue in " + view_name(mlo->contact->view), plate_view(*mlo)});
  }
  const double width = 1.0 / double(shapes.size());
  std::vector<Sight> sights;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    Panel& panel = picture.panel(double(k) * width, 0, double(k + 1) * width, 1);
    // First the column, so that the tumour in it is not hidden.
    add_columns(panel, *input.curves, shapes[k].line);
    add_body(panel, shapes[k].mesh, shapes[k].points, style);
    sights.push_back(
        {panel, shapes[k].view, "(" + std::string(1, char('a' + k)) + ") " + shapes[k].caption});
  }
  finish(sights);
}

}  // namespace breast
