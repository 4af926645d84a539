// segment: labels of one breast from a prone T1 MR scan.
#include "segment/segment.hpp"

#include <cmath>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/table.hpp"
#include "io/label_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "segment/measures.hpp"
#include "segment/overlay.hpp"

using namespace breast;

namespace {

/// Clicked points: a table with columns x_mm y_mm z_mm (or x y z), patient LPS.
std::vector<Vec3> read_points(const std::filesystem::path& file) {
  const Table table = read_table(file);
  std::vector<Vec3> points;
  for (std::size_t row = 0; row < table.rows.size(); ++row) points.push_back(table.point(row, ""));
  if (points.empty()) throw input_error(file.string(), ": no points");
  return points;
}

/// Points of a chest-wall surface; of a file by --points only those marked chest wall.
std::vector<Vec3> surface_points(const TriMesh& surface, const std::filesystem::path& file) {
  const auto kind = surface.point_data.find("surface");
  if (kind == surface.point_data.end()) return surface.points;
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    if (kind->second[n] == 1) points.push_back(surface.points[n]);
  }
  if (points.empty()) {
    throw input_error(file.string(), ": its scalar 'surface' marks no point as chest wall (1)");
  }
  return points;
}

bool is_table(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".tsv" || ending == ".txt";
}

Volume<float> read_wall_labels(const std::filesystem::path& file, std::string& sha256) {
  if (file.extension() != ".vtkhdf") {
    VolumeSource source;
    Volume<float> volume = read_volume(file, 0, &source);
    sha256 = source.content_sha256;
    return volume;
  }
  const LabelVolume labels = read_labels(file);
  sha256 = labels.content_sha256;
  Volume<float> volume(labels.grid);
  volume.voxels.assign(labels.tissue.begin(), labels.tissue.end());
  return volume;
}

void report_measures(Report& report, Table& table, const Segmentation& result) {
  table.columns = {"quantity", "value"};
  tell(measures_of(result), table, report);
  report.set("landmarks/nipple/imaged", result.labels.landmarks.at("nipple"));
  report.set("nipple_base", result.nipple_base);
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path scan_file, labels_file, wall_file, points_file, overlay_file, measures_file;
  std::string side, interior = "threshold";
  SegmentOptions options;
  int series = 0;
  Tool tool("segment", "labels of one breast from a prone T1 MR scan");
  tool.describe(
      "Finds the body, the coil's uneven sensitivity, the chest wall (minimum cut), the breast's "
      "extent "
      "on it, fat, fibroglandular tissue, skin and nipple. Everything behind the chest wall is "
      "labelled "
      "muscle, the rest of the body other.");
  tool.cite("Pathmanathan et al. 2008, section II-A; Li et al., IEEE TPAMI 28:119 (2006)");
  tool.input(scan_file, "MR", "scan: .nrrd, .nii, .nii.gz, .mha, or a DICOM folder");
  tool.output(labels_file, "LABELS.vtkhdf", "tissue labels of the chosen breast");
  tool.choice(side, "--side", {"left", "right"}, "the patient's left or right breast")
      .required("--side");
  tool.integer(series, "--series", "N", "which series of a DICOM folder (0: the only one)", 0,
               10000);
  tool.input_file(
      wall_file, "--chest-wall", "FILE|POINTS",
      "corrected chest wall: label map (code 4 behind the wall), surface (.vtp; of a file by "
      "--points its chest wall), or table of clicked points x_mm y_mm z_mm (.tsv)");
  tool.choice(interior, "--interior", {"threshold", "region-growing"},
              "what decides between fat and fibroglandular tissue: threshold: midway between their "
              "brightness (closer to known truth); region-growing: the paper's 3-D "
              "confidence-connected growing of fat. The report compares both");
  tool.output_file(points_file, "--points", "OUT.vtp", "skin and chest-wall data points");
  tool.output_file(overlay_file, "--overlay", "OUT.png",
                   "slices with contours, to judge the result by");
  tool.output_file(measures_file, "--measures", "OUT.tsv", "every number measured, as a table");
  tool.number(
      options.wall_shift, "--chest-wall-shift", "SIGMAS",
      "move the chest wall by this many of its own standard deviations (--points: sigma_mm), "
      "backwards when positive: what its uncertainty does to the result",
      -3, 3);
  tool.example("segment scan.nrrd labels.vtkhdf --side left --overlay look.png",
               "the left breast, with a picture");
  tool.example("segment dicom/ labels.vtkhdf --side right --series 2 --chest-wall clicked.tsv",
               "second series of a folder, chest wall corrected by clicked points");
  return tool.main(argc, argv, [&](Run& run) {
    options.side = side_from_name(side);
    if (interior == "region-growing") options.interior = Interior::region_growing;
    VolumeSource source;
    Volume<float> scan;
    {
      const Timer::Scope phase(run.timer(), "read");
      scan = read_volume(scan_file, series, &source);
    }
    std::vector<Run::Input> inputs{{scan_file, source.content_sha256, nullptr}};
    if (!wall_file.empty()) {
      std::string sha256;
      if (is_table(wall_file)) {
        options.wall_points = read_points(wall_file);
        Sha256 hash;
        for (const Vec3& point : options.wall_points) hash.update(point.data(), 3 * sizeof(double));
        sha256 = hash.hex();
      } else if (wall_file.extension() == ".vtp") {
        const TriMesh surface = read_surface(wall_file);
        options.wall_points = surface_points(surface, wall_file);
        options.wall_points_of_surface = true;
        sha256 = surface.content_sha256;
      } else {
        options.wall_labels = read_wall_labels(wall_file, sha256);
      }
      inputs.push_back({wall_file, sha256, nullptr});
    }
    Segmentation result = segment_breast(scan, options, run.progress(), run.timer());
    for (const std::string& doubt : result.doubts) run.warn(doubt);
    result.labels.history = run.history(inputs);
    Table measures;
    report_measures(run.report(), measures, result);
    run.report().set("interior", interior);
    const Timer::Scope phase(run.timer(), "write");
    if (!overlay_file.empty()) write_overlay(overlay_file, scan, result.labels);
    if (!points_file.empty()) write_surface(points_file, result.points);
    if (!measures_file.empty()) write_table(measures_file, measures);
    write_labels(labels_file, result.labels);
  });
}
