// SPDX-License-Identifier: GPL-3.0-or-later
#include "lineage/origin.hpp"

namespace breast {

namespace {

Eigen::AlignedBox3d box_of(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : points) box.extend(point);
  return box;
}

Eigen::AlignedBox3d box_of(const Grid& grid) {
  Eigen::AlignedBox3d box;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 index;
    for (int d = 0; d < 3; ++d) index[d] = (corner >> d & 1) != 0 ? grid.size[d] - 0.5 : -0.5;
    box.extend(grid.to_patient(index));
  }
  return box;
}

// The breast; where the labels show none, such as those of a chest wall alone, everything but air.
Eigen::AlignedBox3d box_of(const LabelVolume& labels) {
  Eigen::AlignedBox3d breast, body;
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const Tissue tissue = labels.at(i, j, k);
        if (tissue == Tissue::air) continue;
        const Vec3 at = grid.to_patient(Vec3(i, j, k));
        body.extend(at);
        if (is_breast(tissue)) breast.extend(at);
      }
    }
  }
  return breast.isEmpty() ? body : breast;
}

std::vector<Vec3> nodes_of(const HermiteSheet& sheet) {
  std::vector<Vec3> nodes;
  for (const HermiteSheet::Node& node : sheet.nodes) nodes.push_back(node.x);
  return nodes;
}

Stage stage_of(const HexMesh& mesh) {
  if (mesh.reference.empty()) return Stage::mesh;
  return mesh.contact || mesh.gravity.norm() > 0 ? Stage::result : Stage::reference;
}

}  // namespace

Origin origin_of(const std::filesystem::path& file, const HexMesh& mesh) {
  Origin origin{file, stage_of(mesh), mesh.content_sha256, &mesh.history};
  origin.side = mesh.side;
  origin.place = box_of(mesh.imaged);
  if (const Landmark* nipple = mesh.landmark("nipple")) origin.nipple = nipple->imaged;
  origin.mesh = &mesh;
  return origin;
}

Origin origin_of(const std::filesystem::path& file, const LabelVolume& labels, bool states_side) {
  Origin origin{file, Stage::labels, labels.content_sha256, &labels.history};
  origin.scan_sha256 = labels.scan_sha256;
  if (states_side) origin.side = labels.side;
  origin.place = box_of(labels);
  if (const auto nipple = labels.landmarks.find("nipple"); nipple != labels.landmarks.end())
    origin.nipple = nipple->second;
  origin.labels = &labels;
  return origin;
}

Origin origin_of(const std::filesystem::path& file, const BreastGeometry& geometry) {
  Origin origin{file, Stage::geometry, geometry.content_sha256, &geometry.history};
  origin.side = geometry.side;
  origin.place = box_of(nodes_of(geometry.skin)).merged(box_of(nodes_of(geometry.wall)));
  origin.nipple = geometry.nipple;
  return origin;
}

Origin origin_of(const std::filesystem::path& file, const Mammogram& image) {
  Origin origin{file, Stage::result, image.content_sha256, &image.history};
  origin.side = image.side;
  return origin;
}

Origin origin_of(const std::filesystem::path& file, const TriMesh& surface) {
  Origin origin{file, Stage::labels, surface.content_sha256, &surface.history};
  origin.place = box_of(surface.points);
  return origin;
}

Origin origin_of(const std::filesystem::path& file, const PolyLines& lines) {
  return {file, Stage::result, lines.content_sha256, &lines.history};
}

Origin origin_of_scan(const std::filesystem::path& file, const std::string& sha256,
                      const Grid& grid) {
  Origin origin{file, Stage::scan, sha256};
  origin.place = box_of(grid);
  return origin;
}

Origin origin_of_truth(const std::filesystem::path& file, const Table& truth, Side side) {
  Origin origin{file, Stage::labels, ""};
  const bool in_scan = truth.has("prone_x_mm");  // otherwise only positions between plates
  for (std::size_t row = 0; row < truth.rows.size(); ++row) {
    if (truth.cell(row, "side") != side_name(side)) continue;
    origin.side = side;
    if (in_scan) {
      const Vec3 at = truth.point(row, "prone_");
      origin.place.extend(at);
      if (truth.cell(row, "landmark") == "nipple") origin.nipple = at;
    }
    if (!truth.has(truth_scan_column)) continue;
    const std::string& scan = truth.cell(row, truth_scan_column);
    if (scan != empty_cell) origin.scan_sha256 = scan;
  }
  return origin;
}

Origin origin_of_points(const std::filesystem::path& file, const std::vector<Vec3>& points) {
  Origin origin{file, Stage::labels, ""};
  origin.place = box_of(points);
  return origin;
}

}  // namespace breast
