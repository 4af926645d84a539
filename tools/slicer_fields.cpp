// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement fields of a run, with their errors.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "export/slicer/field_check.hpp"
#include "export/slicer/warp.hpp"
#include "io/field_file.hpp"
#include "io/volume_file.hpp"
#include "slicer_files.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// The grid of the scan with thick slices divided into equal parts, so that its points include those
// of the scan.
Grid lattice_of(const SlicerRun& run) {
  constexpr double most_mm = 1.25, rounding = 1e-6;
  Grid lattice = run.scan ? run.scan->grid : run.labels.grid;
  for (int d = 0; d < 3; ++d) {
    lattice.spacing[d] /= std::ceil(lattice.spacing[d] / most_mm - rounding);
  }
  return lattice;
}

struct Named {
  std::string from, to;
  std::string name() const { return from + "-points-to-" + to; }
};

std::vector<std::pair<std::string, std::string>> notes_of(const Named& named) {
  return {
      {"takes_points_of", named.from},
      {"to", named.to},
      {"in_3D_Slicer", "applied to what lies in " + named.to + ", it shows that in " + named.from}};
}

class FieldWriter {
 public:
  FieldWriter(const fs::path& folder, const SlicerRun& slicer_run, const FieldOptions& options,
              Run& run)
      : folder_(folder), slicer_run_(slicer_run), options_(options), run_(run) {
    table_.columns = {"field",
                      "grid_points",
                      "mean_mm",
                      "max_mm",
                      "beyond_0.05_mm_percent",
                      "smallest_det",
                      "outside_into_body_percent"};
  }

  void add(const RunState& state) {
    const HexMesh& mesh = state.mesh;
    const Grid grid = covering_grid(lattice_of(slicer_run_), {&mesh.imaged, &mesh.points},
                                    options_.margin, options_.spacing);
    const DisplacementField there =
        write({"scan", state.name}, mesh, mesh.imaged, mesh.points, grid);
    const DisplacementField back =
        write({state.name, "scan"}, mesh, mesh.points, mesh.imaged, grid);
    const RoundTrip trip = check_round_trip(there, back, mesh, mesh.imaged);
    run_.report().set("fields/" + state.name + "_round_trip/mean_mm", trip.mean_mm);
    run_.report().set("fields/" + state.name + "_round_trip/max_mm", trip.max_mm);
    if (state.name == "supine" && slicer_run_.scan) write_warped(back);
  }

  std::vector<SceneItem> finish() {
    run_.print(table_.text());
    return std::move(items_);
  }

 private:
  DisplacementField write(const Named& named, const HexMesh& mesh, const std::vector<Vec3>& from,
                          const std::vector<Vec3>& to, const Grid& grid) {
    DisplacementField field;
    {
      const Timer::Scope phase(run_.timer(), "fields");
      field = displacement_field(mesh, from, to, grid, run_.progress(), named.name());
    }
    {
      const Timer::Scope phase(run_.timer(), "check");
      tell(named, field, check_field(field, mesh, from, to));
    }
    const Timer::Scope phase(run_.timer(), "write");
    run_.progress().update("writing", -1, named.name());
    write_field(folder_ / (named.name() + ".nrrd"), grid, field.vectors, notes_of(named));
    write_volume(folder_ / (named.name() + "-part.nrrd"), part_volume(field));
    items_.push_back({SceneKind::transform,
                      named.name(),
                      named.name() + ".nrrd",
                      false,
                      {},
                      1,
                      "applied to what lies in " + named.to + ", it shows that in " + named.from});
    return field;
  }

  void tell(const Named& named, const DisplacementField& field, const FieldCheck& check) {
    const std::string key = "fields/" + named.name() + "/";
    Report& report = run_.report();
    report.set(key + "grid_points", field.grid.voxels());
    report.set(key + "spacing_mm", field.grid.spacing);
    report.set(key + "checked_points", check.points);
    report.set(key + "mean_mm", check.mean_mm);
    report.set(key + "max_mm", check.max_mm);
    report.set(key + "beyond_0.05_mm_percent", check.beyond_percent);
    report.set(key + "smallest_det", check.smallest_det);
    report.set(key + "outside_into_body_percent", check.outside_into_body_percent);
    table_.rows.push_back(
        {named.name(), std::to_string(field.grid.voxels()), format_fixed(check.mean_mm, 4),
         format_fixed(check.max_mm, 4), format_fixed(check.beyond_percent, 1),
         format_fixed(check.smallest_det, 3), format_fixed(check.outside_into_body_percent, 3)});
    if (check.beyond_percent > 0) {
      run_.warn(message(named.name(), ": ", format_fixed(check.beyond_percent, 1), " % of ",
                        check.points, " points of the body lie farther than ", accuracy_mm,
                        " mm from the element map, at most ", format_fixed(check.max_mm, 3),
                        " mm, because the gradient of the map jumps between elements within a grid "
                        "cell; a smaller --spacing reduces this"));
    }
    if (!(check.smallest_det > 0)) {
      run_.warn(message(named.name(), ": folds in at least one cell (determinant ",
                        format_fixed(check.smallest_det, 3), ")"));
    }
  }

  void write_warped(const DisplacementField& from_supine) {
    const Timer::Scope phase(run_.timer(), "warp");
    run_.progress().update("writing", -1, "scan-in-supine");
    write_volume(folder_ / "scan-in-supine.nrrd", warped(*slicer_run_.scan, from_supine));
    items_.insert(items_.begin(), {SceneKind::volume,
                                   "scan in supine",
                                   "scan-in-supine.nrrd",
                                   true,
                                   {},
                                   1,
                                   "the MR warped by the element map, 0 outside the body"});
  }

  const fs::path& folder_;
  const SlicerRun& slicer_run_;
  const FieldOptions& options_;
  Run& run_;
  Table table_;
  std::vector<SceneItem> items_;
};

}  // namespace

std::vector<SceneItem> write_fields(const fs::path& folder, const SlicerRun& slicer_run,
                                    const FieldOptions& options, Run& run) {
  FieldWriter writer(folder, slicer_run, options, run);
  for (const RunState& state : slicer_run.states) {
    if (state.name != "prone" && state.name != "stress-free") writer.add(state);
  }
  return writer.finish();
}

}  // namespace breast
