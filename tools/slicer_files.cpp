// SPDX-License-Identifier: GPL-3.0-or-later
#include "slicer_files.hpp"

#include <cmath>
#include <limits>
#include <map>

#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/state_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "meshing/boundary_surface.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

std::array<double, 3> colour_of(const std::string& state) {
  static const std::map<std::string, std::array<double, 3>> colours = {
      {"prone", {0.86, 0.66, 0.55}},
      {"stress-free", {0.7, 0.7, 0.7}},
      {"supine", {0.30, 0.60, 0.90}},
      {"cc", {0.95, 0.65, 0.20}},
      {"mlo", {0.60, 0.80, 0.30}}};
  return colours.at(state);
}

bool shown(const std::string& state) {
  return state == "prone" || state == "supine";
}

void write_scan(const fs::path& file, const Volume<float>& scan) {
  constexpr float most = std::numeric_limits<std::int16_t>::max();
  bool whole = true;
  for (const float value : scan.voxels)
    whole = whole && std::abs(value) <= most && value == std::round(value);
  if (!whole) return write_volume(file, scan);
  Volume<std::int16_t> integers(scan.grid);
  for (std::size_t n = 0; n < scan.voxels.size(); ++n)
    integers.voxels[n] = std::int16_t(scan.voxels[n]);
  write_volume(file, integers);
}

std::vector<SceneItem> write_state_files(const fs::path& folder, const RunState& state,
                                         const History& history) {
  HexMesh mesh = state.mesh;
  mesh.history = history;
  const std::string volume = state.name + ".vtu", skin = state.name + "-skin.vtp",
                    landmarks = "landmarks-" + state.name + ".mrk.json";
  write_state(folder / volume, mesh);
  TriMesh surface = boundary_surface(mesh);
  surface.history = history;
  write_surface(folder / skin, surface);
  Markups points{"landmarks, " + state.title, false, colour_of(state.name), {}};
  for (const Landmark& landmark : mesh.landmarks) {
    // If nothing was moved, the point of the scan itself is written: read back, it gives the same
    // mesh.
    const bool exact = state.name == "prone" && landmark.moved == 0;
    points.points.push_back(
        {landmark.name, exact ? landmark.imaged : landmark_position(mesh, mesh.points, landmark)});
  }
  write_markups(folder / landmarks, points);
  const auto colour = colour_of(state.name);
  const bool visible = shown(state.name);
  return {{SceneKind::model, "skin, " + state.title, skin, visible, colour, 0.35,
           "boundary of the model; scalar part: 0 skin, 1 cut, 2 chest wall"},
          {SceneKind::model, "volume, " + state.title, volume, false, colour, 1,
           "hexahedra with tissue and displacement"},
          {SceneKind::points, points.name, landmarks, visible, colour, 1,
           "landmarks of the model in this shape"}};
}

// Writes every section of one line of curve.vtp as a file.
void add_curve(const fs::path& folder, const PolyLines& lines, const std::string& line,
               const std::string& name, const std::string& title, bool visible,
               std::vector<SceneItem>& items) {
  int stretch = 0;
  for (std::size_t n = 0; n < lines.lines.size() && n < lines.line_names.size(); ++n) {
    if (lines.line_names[n] != line || lines.lines[n].size() < 2) continue;
    ++stretch;
    const std::string end = stretch > 1 ? "-" + std::to_string(stretch) : "";
    Markups curve{title, true, {1, 0.2, 0.2}, {}};
    for (const int point : lines.lines[n])
      curve.points.push_back({"", lines.points[std::size_t(point)]});
    const std::string file = name + end + ".mrk.json";
    write_markups(folder / file, curve);
    items.push_back({SceneKind::curve, title + end, file, visible, curve.colour, 1,
                     "possible positions of a point seen in the CC view"});
  }
}

}  // namespace

std::vector<SceneItem> write_shapes(const fs::path& folder, const SlicerRun& run,
                                    const History& history) {
  std::vector<SceneItem> items;
  if (run.scan) {
    write_scan(folder / "scan.nrrd", *run.scan);
    items.push_back({SceneKind::volume, "scan", "scan.nrrd", true, {}, 1, "the MR, prone"});
  }
  write_segmentation(folder / "labels.seg.nrrd", run.labels);
  items.push_back({SceneKind::segmentation,
                   "labels",
                   "labels.seg.nrrd",
                   true,
                   {},
                   1,
                   "tissues of the scan; may be corrected and given back with --chest-wall or "
                   "as labels"});
  for (const RunState& state : run.states) {
    for (SceneItem& item : write_state_files(folder, state, history))
      items.push_back(std::move(item));
  }
  if (!run.curve) return items;
  add_curve(folder, *run.curve, "column in imaged", "column-prone", "CC column, prone", true,
            items);
  add_curve(folder, *run.curve, "column in MLO", "column-mlo", "CC column, compressed MLO", false,
            items);
  add_curve(folder, *run.curve, "curve", "curve-mlo", "MLO curve, on the detector", false, items);
  return items;
}

}  // namespace breast
