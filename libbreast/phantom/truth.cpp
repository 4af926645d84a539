// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/truth.hpp"

#include "core/units.hpp"
#include "mesh/quality.hpp"
#include "mesh/shape.hpp"

namespace breast {

TriMesh boundary_surface(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                         const std::vector<Face>& faces) {
  const int n = mesh.order == 2 ? 4 : 1;
  TriMesh surface;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const int first = int(surface.points.size());
    for (int b = 0; b <= n; ++b)
      for (int a = 0; a <= n; ++a) {
        const QuadShape shape = quad_shape(mesh.order, Vec2(2.0 * a / n - 1, 2.0 * b / n - 1));
        Vec3 x = Vec3::Zero();
        for (std::size_t i = 0; i < nodes.size(); ++i) x += shape.values[i] * nodal[nodes[i]];
        surface.points.push_back(x);
      }
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        const int p = first + b * (n + 1) + a, q = p + n + 1;
        surface.triangles.push_back({p, p + 1, q + 1});
        surface.triangles.push_back({p, q + 1, q});
      }
  }
  return surface;
}

void add_landmarks(const PhantomBreast& breast, const Postures& postures, Table& table) {
  if (table.columns.empty()) {
    table.columns = {"landmark", "side"};
    for (const char* posture : {"stress_free", "prone", "supine"})
      for (const char* axis : {"_x_mm", "_y_mm", "_z_mm"})
        table.columns.push_back(std::string(posture) + axis);
  }
  const HexMesh& mesh = breast.mesh;
  for (const Landmark& landmark : mesh.landmarks) {
    std::vector<std::string> row = {landmark.name, std::string(side_name(mesh.side))};
    for (const auto* nodal : {&postures.stress_free, &mesh.points, &postures.supine}) {
      const Vec3 x = landmark_position(mesh, *nodal, landmark);
      for (int a = 0; a < 3; ++a) row.push_back(format_fixed(x[a], 6));
    }
    table.rows.push_back(std::move(row));
  }
}

Table tumour_place(const HexMesh& mesh) {
  const Vec3 x = landmark_position(mesh, mesh.points, *mesh.landmark("tumour"));
  Table table{{"x_mm", "y_mm", "z_mm"}, {}};
  table.rows.push_back({format_fixed(x.x(), 6), format_fixed(x.y(), 6), format_fixed(x.z(), 6)});
  return table;
}

void report_breast(const PhantomBreast& breast, const Postures& postures, Report& report) {
  const HexMesh& mesh = breast.mesh;
  const std::string side = std::string(side_name(mesh.side)) + "/";
  report.set(side + "elements", mesh.elements());
  report.set(side + "unknowns", postures.prone.unknowns);
  report.set(side + "newton_iterations", postures.prone.newton_iterations);
  report.set(side + "residual", postures.prone.residual);
  report.set(side + "min_det_F", postures.prone.min_det_F);
  report.set(side + "min_scaled_jacobian", mesh_quality(mesh, mesh.points).min_scaled_jacobian);
  report.set(side + "mesh_ml", mesh_volume(mesh, mesh.points) / mm3_per_ml);
  report.set(side + "gland_ml", breast.gland.volume_ml());
  report.set(side + "imaged_gap_mm", postures.imaged_gap);
  for (const char* name : {"nipple", "tumour"}) {
    const Landmark& landmark = *mesh.landmark(name);
    const Vec3 prone = landmark_position(mesh, mesh.points, landmark);
    const Vec3 supine = landmark_position(mesh, postures.supine, landmark);
    const std::string key = side + "landmarks/" + name + "/";
    report.set(key + "imaged", prone);
    report.set(key + "position", supine);
    report.set(key + "displacement_from_scan_mm", Vec3(supine - prone));
    report.set(key + "distance_mm", (supine - prone).norm());
  }
}

void report_volumes(const LabelVolume& labels, const std::string& key, Report& report) {
  std::array<std::size_t, n_tissues> count{};
  for (std::uint8_t tissue : labels.tissue) ++count[tissue];
  for (Tissue tissue : {Tissue::fat, Tissue::fibroglandular, Tissue::skin}) {
    const double ml = double(count[std::size_t(tissue)]) * labels.grid.voxel_volume() / mm3_per_ml;
    report.set(key + "/" + std::string(tissue_name(tissue)), ml);
  }
}

}  // namespace breast
