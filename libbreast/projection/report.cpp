// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/report.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

Vec2 image_position(const HexMesh& mesh, const Mammogram& image, const Landmark& landmark) {
  return image.pose.project(landmark_position(mesh, mesh.points, landmark));
}

}  // namespace

void write_report(const HexMesh& mesh, const Mammogram& image, const ProjectionReport& projection,
                  Report& report) {
  report.set("side", side_name(image.side));
  report.set("view", view_name(image.view));
  report.set("angle_deg", image.pose.angle_deg);
  report.set("energy", image.energy);
  report.set("pixel_mm", image.pixel);
  report.set("width_pixels", image.width);
  report.set("height_pixels", image.height);
  report.set("thickness_mm", mesh.contact->thickness_mm);
  report.set("brightest_path", double(*std::max_element(image.path.begin(), image.path.end())));
  report.set("mesh_volume_ml", projection.mesh_volume / mm3_per_ml);
  report.set("imaged_volume_ml", projection.imaged_volume / mm3_per_ml);
  report.set("volumes_ml/fat", projection.volumes.fat / mm3_per_ml);
  report.set("volumes_ml/fibroglandular", projection.volumes.fibroglandular / mm3_per_ml);
  report.set("volumes_ml/skin", projection.volumes.skin / mm3_per_ml);
  report.set("volumes_ml/tumour", projection.volumes.tumour / mm3_per_ml);
  report.set("volumes_ml/muscle", projection.volumes.muscle / mm3_per_ml);
  report.set("muscle_cm2", projection.muscle_columns * image.pixel * image.pixel / mm2_per_cm2);
  report.set("unlabelled_percent", 100 * projection.unlabelled);
  report.set("columns_through_back", projection.back_columns);
  for (const Landmark& landmark : mesh.landmarks) {
    const Vec2 uv = image_position(mesh, image, landmark);
    const std::string key = "landmarks/" + landmark.name + "/";
    report.set(key + "imaged", landmark.imaged);
    report.set(key + "position", landmark_position(mesh, mesh.points, landmark));
    report.set(key + "uv_mm", std::vector<double>{uv.x(), uv.y()});
  }
}

void refuse_foreign_labels(const ProjectionReport& projection, const std::string& labels) {
  constexpr double most = 0.5;  // a layer of muscle alone is less
  if (!(projection.unlabelled > most)) return;
  throw input_error(
      labels, ": ", format_fixed(100 * projection.unlabelled, 1),
      " % of the compressed tissue lies in voxels labelled air, muscle or other (at most ",
      100 * most, " %): these labels are of another breast");
}

std::vector<std::string> doubts(const HexMesh& mesh, const Mammogram& image,
                                const ProjectionReport& projection) {
  std::vector<std::string> doubts;
  for (const Landmark& landmark : mesh.landmarks) {
    const double u = image_position(mesh, image, landmark).x();
    if (u >= 0) continue;
    doubts.push_back(landmark.name + " lies " + format_fixed(-u, 1) +
                     " mm behind the image's posterior edge");
  }
  if (projection.unlabelled > 0.05) {
    doubts.push_back(
        format_fixed(100 * projection.unlabelled, 1) +
        " % of the tissue lies in voxels labelled air, muscle or other (taken as fat)");
  }
  return doubts;
}

}  // namespace breast
