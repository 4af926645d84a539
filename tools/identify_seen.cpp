// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify_seen.hpp"

#include "core/error.hpp"
#include "core/table.hpp"
#include "identification/landmark_pairs.hpp"
#include "identification/seen_skin.hpp"
#include "identify_landmarks.hpp"
#include "io/label_file.hpp"
#include "io/surface_file.hpp"
#include "mesh/view.hpp"

namespace breast {

namespace {

const Landmark& nipple_of(const IdentifyChoices& c, const HexMesh& mesh) {
  const Landmark* nipple = mesh.landmark("nipple");
  if (nipple == nullptr) throw input_error(c.mesh.string(), ": it has no landmark 'nipple'");
  return *nipple;
}

std::vector<LandmarkPair> marked_pairs(const IdentifyChoices& c, const HexMesh& mesh) {
  std::vector<LandmarkPair> pairs;
  if (!c.landmarks.empty())
    pairs = read_landmark_pairs(c.landmarks, c.second_landmarks, mesh.side, c.observer);
  if (c.nipple.empty()) return pairs;
  const std::string name = pairs.empty() ? "nipple" : "nipple (--nipple)";
  pairs.push_back(
      {name, nipple_of(c, mesh).imaged, Vec3(c.nipple[0], c.nipple[1], c.nipple[2]), c.observer});
  return pairs;
}

std::vector<SeenForce> forces_of(const Table& table) {
  std::vector<SeenForce> forces;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    SeenForce seen{table.number(row, "thickness_mm"), table.number(row, "force_N"), 0};
    seen.deviation = table.has("sd_N") ? table.number(row, "sd_N") : 0.1 * seen.force + 0.5;
    if (!(seen.thickness > 0 && seen.force > 0 && seen.deviation > 0)) {
      throw input_error(table.name, ", row ", row + 1,
                        ": thickness_mm, force_N and sd_N must be above 0");
    }
    forces.push_back(seen);
  }
  if (forces.empty()) throw input_error(table.name, ": no row");
  return forces;
}

Vec3 wall_middle(const HexMesh& mesh) {
  const std::vector<int> wall = nodes_of(mesh, mesh.pectoral_faces);
  Vec3 middle = Vec3::Zero();
  for (const int node : wall) middle += mesh.imaged[std::size_t(node)] / double(wall.size());
  return middle;
}

// Pairs with their second position transformed into the frame of the mesh.
std::vector<LandmarkPair> laid_over(std::vector<LandmarkPair> pairs, const SecondScan& scan) {
  if (!scan.ribs) return pairs;
  for (LandmarkPair& pair : pairs) pair.second = scan.ribs->motion.origin_of(pair.second);
  return pairs;
}

}  // namespace

SecondScan read_second_scan(const IdentifyChoices& c, const HexMesh& mesh, Pairs& pairs) {
  SecondScan scan;
  std::optional<LabelVolume> second;
  if (!c.surface.empty()) scan.surface = read_surface(c.surface);
  if (!c.labels.empty()) {
    second = read_labels(c.second_labels);
    const LabelVolume first = read_labels(c.labels);
    pairs.check("MESH", origin_of(c.mesh, mesh), "--labels", origin_of(c.labels, first));
    pairs.check("MESH", origin_of(c.mesh, mesh), "--second-labels",
                origin_of(c.second_labels, *second));
    if (!c.surface.empty())
      pairs.check("--second-labels", origin_of(c.second_labels, *second), "--surface",
                  origin_of(c.surface, scan.surface));
    scan.ribs =
        align_walls(first, *second, wall_middle(mesh), c.align_deviation[0], c.align_deviation[1]);
  }
  const std::vector<LandmarkPair> marks = laid_over(marked_pairs(c, mesh), scan);
  const std::string where = c.landmarks.empty() ? "--nipple" : c.landmarks.string();
  if (!marks.empty()) scan.seen.points = seen_points(mesh, marks, c.outside, where);
  if (!c.surface.empty()) {
    if (scan.ribs) {
      const Mat3 back = scan.ribs->motion.rotation().transpose();
      for (Vec3& point : scan.surface.points) point = scan.ribs->motion.origin_of(point);
      for (Vec3& normal : scan.surface.normals) normal = back * normal;
    }
    scan.seen.surface = seen_surface(scan.surface, c.surface_error, c.surface.string());
  }
  if (!c.forces.empty()) scan.seen.forces = forces_of(read_table(c.forces));
  scan.seen.press.view = view_named(c.view);
  scan.seen.press.angle_deg = view_angle_deg(scan.seen.press.view);
  scan.seen.press.plates.standoff = c.standoff;
  scan.seen.press.plates.edge_radius = c.edge_radius;
  if (!c.judge.empty()) {
    scan.judged =
        seen_points(mesh, laid_over(read_landmark_pairs(c.judge, {}, mesh.side, c.observer), scan),
                    c.outside, c.judge.string());
  } else if (second && c.nipple.empty() && second->landmarks.contains("nipple")) {
    const Vec3 at = scan.ribs->motion.origin_of(second->landmarks.at("nipple"));
    scan.judged = seen_points(mesh, {{"nipple", nipple_of(c, mesh).imaged, at, c.observer}},
                              c.outside, c.second_labels.string());
    scan.judged.front().name = "nipple (segmented)";
  }
  return scan;
}

TriMesh seen_beside(const SecondScan& scan, const Identified& found) {
  TriMesh out = scan.surface;
  const Mat3 back = found.motion.rotation().transpose();
  for (Vec3& point : out.points) point = found.motion.origin_of(point);
  for (Vec3& normal : out.normals) normal = back * normal;
  return out;
}

}  // namespace breast
