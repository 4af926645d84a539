// SPDX-License-Identifier: GPL-3.0-or-later
#include "slicer_run.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"
#include "tool_pairs.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

struct Kind {
  const char *file, *name, *title;
};
constexpr std::array<Kind, 5> kinds = {{{"mesh", "prone", "prone, as scanned"},
                                        {"reference", "stress-free", "stress-free"},
                                        {"supine", "supine", "supine"},
                                        {"cc", "cc", "compressed, CC"},
                                        {"mlo", "mlo", "compressed, MLO"}}};

void read_scan(const fs::path& file, int series, SlicerRun& result, Pairs& pairs) {
  VolumeSource source;
  result.scan = read_volume(file, series, &source);
  pairs.check("labels.vtkhdf", origin_of(result.labels_file, result.labels), "--scan",
              origin_of_scan(file, source.content_sha256, result.scan->grid));
  result.scan_file = file;
  result.scan_sha256 = source.content_sha256;
}

}  // namespace

std::vector<Run::Input> SlicerRun::inputs() const {
  std::vector<Run::Input> list{{labels_file, labels.content_sha256, &labels.history}};
  if (curve) list.push_back({curve_file, curve->content_sha256, &curve->history});
  if (scan) list.push_back({scan_file, scan_sha256, nullptr});
  for (const RunState& state : states) {
    list.push_back({state.file, state.mesh.content_sha256, &state.mesh.history});
  }
  return list;
}

SlicerRun read_run(const fs::path& folder, const fs::path& scan, int series, Run& run) {
  if (!fs::is_directory(folder)) {
    throw input_error(folder.string(),
                      ": is not the folder of a run (labels.vtkhdf, mesh.vtkhdf ...)");
  }
  for (const char* needed : {"labels.vtkhdf", "mesh.vtkhdf"}) {
    if (!fs::is_regular_file(folder / needed)) {
      throw input_error(
          folder.string(), ": has no ", needed,
          ", which every run has; give the folder that the pipeline filled (runs/CASE)");
    }
  }
  SlicerRun result;
  result.labels_file = folder / "labels.vtkhdf";
  result.labels = read_labels(result.labels_file);
  Pairs pairs = pairs_of("export-slicer", run);
  const Origin labels = origin_of(result.labels_file, result.labels);
  result.labels.scan_sha256 = scan_behind(labels);
  result.states.reserve(kinds.size());  // origins point to the meshes
  for (const Kind& kind : kinds) {
    const fs::path file = folder / (std::string(kind.file) + ".vtkhdf");
    if (!fs::is_regular_file(file)) continue;
    run.progress().update("reading", -1, file.filename().string());
    result.states.push_back(
        {kind.name, kind.title, file, restricted(read_mesh(file), breast_elements)});
    const Origin prone = origin_of(result.prone().file, result.prone().mesh),
                 shape = origin_of(file, result.states.back().mesh);
    if (result.states.size() == 1)
      pairs.check("labels.vtkhdf", labels, "mesh.vtkhdf", prone);
    else
      pairs.check("mesh.vtkhdf", prone, "other shape", shape);
  }
  if (const fs::path curve = folder / "curve.vtp"; fs::is_regular_file(curve)) {
    result.curve = read_polylines(curve);
    result.curve_file = curve;
    pairs.check("mesh.vtkhdf", origin_of(result.prone().file, result.prone().mesh), "curve.vtp",
                origin_of(curve, *result.curve));
  }
  if (!scan.empty()) read_scan(scan, series, result, pairs);
  return result;
}

}  // namespace breast
