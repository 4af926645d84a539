// SPDX-License-Identifier: GPL-3.0-or-later
// hexmesh: hexahedral mesh of a breast from its Hermite geometry and its labels.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "cli/sibling.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/temporary_folder.hpp"
#include "hexmesh_options.hpp"
#include "io/geometry_file.hpp"
#include "io/markups_file.hpp"
#include "io/mesh_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"
#include "meshing/agreement.hpp"
#include "meshing/attempts.hpp"
#include "meshing/boundary_surface.hpp"
#include "meshing/layers/muscle_layer.hpp"
#include "meshing/layers/surrounding_layers.hpp"
#include "meshing/report.hpp"
#include "meshing/skin.hpp"
#include "meshing/tumour.hpp"

using namespace breast;

namespace {

/// A volume with one value besides 0 is a mask of the tumour, whatever tissue has this value in labels.
TissueCodes codes_of_mask(const Volume<float>& volume) {
  const auto marked = std::find_if(volume.voxels.begin(), volume.voxels.end(),
                                   [](float value) { return value != 0; });
  const bool mask = marked != volume.voxels.end() &&
                    std::all_of(marked, volume.voxels.end(),
                                [&](float value) { return value == 0 || value == *marked; });
  TissueCodes codes;
  if (mask) codes.values = {{0, Tissue::air}, {int(*marked), Tissue::tumour}};
  return codes;
}

/// What --tumour names; nothing for "none" and "auto".
std::optional<Tumour> given_tumour(const std::string& given, const Origin& labels, Pairs& pairs,
                                   Run& run) {
  if (given == "none" || given == "auto") return std::nullopt;
  if (!std::filesystem::exists(given)) return parse_tumour(given);
  if (std::filesystem::path(given).extension() == ".tsv") return read_tumour(given);
  if (is_markups_name(given)) {
    const MarkupPoint point = point_named(read_markups(given), "tumour", "--tumour " + given);
    return Tumour{point.at, 0, "point of 3D Slicer", false};
  }
  const LabelVolume marked = read_tissues(given, {}, run, codes_of_mask);
  pairs.check("LABELS", labels, "--tumour", origin_of(given, marked, false));
  return tumour_of(marked, given);
}

std::optional<Tumour> made_tumour(const LabelVolume& labels, const HexMesh& mesh, Run& run) {
  std::optional<Tumour> made = automatic_tumour(labels, mesh);
  if (!made) {
    run.warn(
        "there is no edge of fibroglandular tissue inside the mesh, so that no artificial "
        "tumour was placed; give a position with --tumour x,y,z");
    return made;
  }
  run.warn(
      "the tumour is artificial: it was not found in the scan. It is named artificial_tumour; "
      "give the position of a real one with --tumour x,y,z, or --tumour none");
  return made;
}

std::vector<MarkupPoint> named_points(const std::filesystem::path& file) {
  if (is_markups_name(file)) return read_markups(file);
  const Table table = read_table(file);
  std::vector<MarkupPoint> points;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    points.push_back({table.cell(row, "name"), table.point(row, "")});
  if (points.empty()) {
    throw input_error(
        "--landmarks ", file.filename().string(),
        ": no points: a table needs columns name, x_mm, y_mm and z_mm, and a row for each");
  }
  return points;
}

/// Names that every file of the chain keeps as they are.
bool is_landmark_name(const std::string& name) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  return !name.empty() && name != "-" && name != "~" && !blank(name.front()) &&
         !blank(name.back()) && name.find('/') == std::string::npos;
}

/// Adds the user's points as landmarks; the mesh's own landmarks (nipple, tumour) keep their
/// positions.
void add_points(const std::vector<MarkupPoint>& points, const std::string& name, HexMesh& mesh) {
  for (const MarkupPoint& point : points) {
    if (!is_landmark_name(point.label)) {
      throw input_error("--landmarks ", name, ": a point at (", point.at.transpose(),
                        ") mm has the name '", point.label,
                        "': give it a label without slashes and outer blanks, and not - or ~");
    }
    const bool known = std::any_of(mesh.landmarks.begin(), mesh.landmarks.end(),
                                   [&](const Landmark& l) { return l.name == point.label; });
    if (known) {
      throw input_error("--landmarks ", name, ": a landmark '", point.label,
                        "' exists already: give the point another name");
    }
    add_landmark(point.label, point.at, mesh);
  }
}

/// A line about something that did not work at first and was done differently.
void mend(const std::string& line, Run& run) {
  run.report().append("mended", line);
  run.warn(line);
}

/// Says which step led to the mesh, where that is not the mesh that was asked for, and why the number of
/// its elements is not.
void note_steps(const MeshChoices& choices, const HexMesh& mesh, const BodyMeshReport& body,
                Run& run) {
  constexpr double most_off = 0.15;
  run.report().set("attempts", body.attempts);
  run.report().set("step", body.step.empty() ? "as asked" : body.step);
  std::string size;
  for (const int n : mesh.template_size) size += (size.empty() ? "" : ",") + std::to_string(n);
  if (!body.step.empty()) {
    mend(message("the mesh that was asked for has a worst scaled Jacobian of ",
                 format_fixed(body.asked_scaled_jacobian, 2), " (wanted: ", wanted_scaled_jacobian,
                 "); taken after ", body.attempts, " attempts: ", mesh.template_name, " ", size,
                 ", found by the step '", body.step, "', with ",
                 format_fixed(body.smoothed_scaled_jacobian, 2)),
         run);
  }
  const double asked = choices.dome.empty() ? std::pow(choices.elements, 3)
                                            : choices.mesh_options(1).size.elements();
  if (std::abs(mesh.elements() / asked - 1) > most_off) {
    run.warn(
        message("the breast has ", mesh.elements(), " elements where ", asked, " were asked for: ",
                body.step.empty() ? "no dome of the right proportions has a number closer to it"
                                  : "those in between have badly shaped elements"));
  }
}

void report_agreement(const char* surface, const SurfaceAgreement& found, Report& report) {
  const std::string key = std::string("agreement/") + surface;
  report.set(key + "_mean_mm", found.distance.mean_mm);
  report.set(key + "_p95_mm", found.distance.p95_mm);
  report.set(key + "_max_mm", found.distance.max_mm);
  report.set(key + "_max_at", found.worst);
  report.set(key + "_seen_percent", 100 * found.seen);
}

/// Refuses a geometry that does not describe the same body as the labels, unless the user accepts
/// it.
void judge_agreement(const MeshChoices& choices, const BreastGeometry& geometry,
                     const LabelVolume& labels, Run& run) {
  const Timer::Scope phase(run.timer(), "agreement");
  const Agreement agreement = agreement_of(geometry, labels);
  report_agreement("skin", agreement.skin, run.report());
  report_agreement("wall", agreement.wall, run.report());
  const auto wrong = mismatch(agreement);
  if (!wrong) return;
  if (!choices.accept_mismatch) {
    throw input_error(*wrong,
                      ": give the labels to which the geometry was fitted, look at this place in "
                      "the overlay of segment, or mesh it nevertheless with --accept-mismatch");
  }
  run.warn(*wrong);
}

void write_boundary(const HexMesh& mesh, const std::filesystem::path& file) {
  TriMesh surface = boundary_surface(mesh);
  surface.history = mesh.history;
  write_surface(file, surface);
}

/// Runs the program tetrahedra on the mesh under its final name.
void fill_with_tetrahedra(const MeshChoices& choices, const HexMesh& mesh, Run& run) {
  Timer::Scope phase(run.timer(), "tetrahedra");
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / choices.mesh.filename();
  write_mesh(file, mesh);
  run.report().copy("tetrahedra",
                    run_sibling("tetrahedra", {file.string(), choices.tetrahedra.string()}));
}

void surround(const MeshChoices& choices, HexMesh& mesh, Run& run) {
  if (!(choices.surroundings_mm > 0)) return;
  const Surroundings around = add_surroundings(choices.surroundings_mm, mesh);
  if (around.layers == 0) {
    run.warn(
        message("tissue around the breast, ", choices.surroundings_mm,
                " mm wide, would fold beyond the cut at every width down to a third of it: the "
                "mesh ends at the cut, as with --surroundings 0; check the skin there"));
  }
  if (around.layers > 0 && around.part < 1) {
    mend(message("tissue around the breast is ", format_fixed(around.mean_mm, 1),
                 " mm wide in the mean, ", format_fixed(100 * around.part, 0),
                 " % of the room for it: wider elements would be badly shaped"),
         run);
  }
  run.report().set("surroundings_mm", around.mean_mm);
  run.report().set("surroundings_part", around.part);
  run.report().set("surrounding_layers", around.layers);
}

void add_muscle(const MeshChoices& choices, const LabelVolume& labels, HexMesh& mesh, Run& run) {
  MuscleThickness muscle;
  if (choices.muscle == "measured") {
    muscle = measured_muscle_thickness(labels, mesh);
  } else {
    muscle.mm = parse_muscle_thickness(choices.muscle);
  }
  if (muscle.mm > 0) add_muscle_layer(muscle.mm, mesh);
  run.report().set("muscle_mm", muscle.mm);
  run.report().set("muscle_seen", muscle.seen);
}

void run_hexmesh(const MeshChoices& choices, Run& run) {
  const BreastGeometry geometry = read_geometry(choices.geometry);
  Pairs pairs = pairs_of("hexmesh", run, choices.foreign.accept_other);
  const LabelInput input = read_label_input(choices.labels, choices.foreign, pairs, run);
  const LabelVolume& labels = input.labels;
  const Origin origin = origin_of(choices.labels, labels);
  pairs.check("GEOMETRY", origin_of(choices.geometry, geometry), "LABELS", origin);
  std::vector<MarkupPoint> points;
  if (!choices.landmarks.empty()) points = named_points(choices.landmarks);
  std::optional<Tumour> tumour = given_tumour(choices.tumour, origin, pairs, run);
  const double skin_mm = choices.skin == "measured" ? measured_skin_thickness(labels, geometry)
                                                    : parse_skin_thickness(choices.skin);
  judge_agreement(choices, geometry, labels, run);
  BodyMeshReport body;
  HexMesh mesh;
  {
    Timer::Scope phase(run.timer(), "mesh");
    mesh = body_mesh(geometry, choices.mesh_options(skin_mm), &body);
  }
  note_steps(choices, mesh, body, run);
  TissueReport tissue;
  {
    Timer::Scope phase(run.timer(), "tissue");
    tissue = assign_tissue(labels, mesh);
  }
  if (const auto coarse = too_coarse(body)) run.warn(*coarse);
  if (choices.skin_as == "membrane") set_membrane_skin(skin_mm, mesh);
  add_nipple(mesh);
  if (choices.tumour == "auto") tumour = made_tumour(labels, mesh, run);
  if (tumour) {
    add_tumour(*tumour, mesh);
    run.report().set("tumour", tumour->origin);
  }
  add_points(points, choices.landmarks.filename().string(), mesh);
  add_muscle(choices, labels, mesh, run);
  surround(choices, mesh, run);
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  write_report(mesh, quality, body, tissue, run.report());
  for (const std::string& doubt : doubts(quality)) run.warn(doubt);
  run.report().set("skin_mm", skin_mm);
  std::vector<Run::Input> inputs{{choices.geometry, geometry.content_sha256, &geometry.history}};
  for (const Run::Input& one : inputs_of(choices.labels, choices.foreign, input))
    inputs.push_back(one);
  mesh.history = run.history(inputs);
  if (!choices.surface.empty()) write_boundary(mesh, choices.surface);
  if (!choices.tetrahedra.empty()) fill_with_tetrahedra(choices, mesh, run);
  write_mesh(choices.mesh, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  MeshChoices choices;
  Tool tool("hexmesh", "hexahedral mesh of a breast from its surface sheets and labels");
  declare_hexmesh(tool, choices);
  return tool.main(argc, argv, [&](Run& run) { run_hexmesh(choices, run); });
}
