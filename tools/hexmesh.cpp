// hexmesh: hexahedral mesh of a breast from its Hermite geometry and its labels.
#include <cmath>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "mesh/quality.hpp"
#include "meshing/body_mesh.hpp"
#include "meshing/skin.hpp"
#include "meshing/tissue.hpp"
#include "meshing/tumour.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path geometry, labels, mesh;
  std::string shape = "dome", skin = "1.45", skin_as = "membrane", tumour = "auto";
  int elements = 16;
  std::vector<double> dome;

  BodyMeshOptions mesh_options(double skin_mm) const {
    BodyMeshOptions options;
    if (shape == "cuboid") {
      options.size = cuboid_size(elements);
    } else {
      options.size = dome.empty() ? dome_near(elements) : dome_size();
    }
    options.skin_layer = skin_as == "layer" ? skin_mm : 0;
    return options;
  }
  DomeSize dome_size() const {
    for (const double number : dome) {
      if (number != std::floor(number) || std::abs(number) > 1000) {
        throw input_error("--dome: ", number, " is not a whole number of elements up to 1000");
      }
    }
    const DomeSize size{int(dome[0]), int(dome[1]), int(dome[2]), int(dome[3])};
    if (size.m < 1)
      throw input_error("--dome: m must be at least 1 (--template cuboid has no layers)");
    check_dome(size);
    return size;
  }
  void check() const {
    if (!dome.empty() && shape == "cuboid")
      throw input_error("--dome goes with --template dome only");
    if (skin != "measured") parse_skin_thickness(skin);
    mesh_options(1);
    if (tumour != "auto" && tumour != "none" && !std::filesystem::exists(tumour))
      parse_tumour(tumour);
  }
};

std::optional<Tumour> choose_tumour(const Choices& choices, const LabelVolume& labels, Run& run) {
  if (choices.tumour == "none") return std::nullopt;
  if (choices.tumour == "auto") {
    std::optional<Tumour> found = automatic_tumour(labels);
    if (!found) run.warn("no fibroglandular tissue in the labels: no artificial tumour was placed");
    return found;
  }
  if (!std::filesystem::exists(choices.tumour)) return parse_tumour(choices.tumour);
  if (std::filesystem::path(choices.tumour).extension() == ".tsv")
    return read_tumour(choices.tumour);
  return tumour_of(read_labels(choices.tumour), choices.tumour);
}

void report_mesh(const HexMesh& mesh, const BodyMeshReport& body, const TissueReport& tissue,
                 Run& run) {
  Report& report = run.report();
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  report.set("elements", mesh.elements());
  report.set("nodes", mesh.nodes());
  report.set("placed_min_scaled_jacobian", body.placed_scaled_jacobian);
  report.set("min_scaled_jacobian", quality.min_scaled_jacobian);
  report.set("median_scaled_jacobian", quality.median_scaled_jacobian);
  report.set("min_det_mm3", quality.min_det);
  report.set("elements_below_02", quality.below_02);
  const auto volumes = tissue_volumes(mesh);
  for (int t = 0; t < n_tissues; ++t) {
    if (volumes[t] > 0) {
      report.set("volumes_ml/" + std::string(tissue_name(Tissue(t))), volumes[t] / mm3_per_ml);
    }
  }
  report.set("volume_ml", body.mesh_volume / mm3_per_ml);
  report.set("fibroglandular_by_fraction_ml", tissue.fibroglandular_volume / mm3_per_ml);
  report.set("fibroglandular_threshold", tissue.gland_threshold);
  report.set("skin_shift_mm", body.skin_shift);
  report.set("segmented_volume_ml", tissue.segmented_volume / mm3_per_ml);
  report.set("volume_error_percent", 100 * (body.mesh_volume / tissue.segmented_volume - 1));
  report.set("sheet_volume_error_percent", 100 * (body.mesh_volume / body.body_volume - 1));
  report.set("outside_breast_percent", 100 * tissue.outside_fraction);
  report.set("breast_missed_percent", 100 * tissue.missed_fraction);
  for (const Landmark& landmark : mesh.landmarks) {
    report.set("landmarks/" + landmark.name + "/imaged", landmark.imaged);
    report.set("landmarks/" + landmark.name + "/moved_mm", landmark.moved);
  }
  if (quality.below_01 > 0) {
    run.warn(message(quality.below_01, " elements have a scaled Jacobian below 0.1 (smallest ",
                     format_fixed(quality.min_scaled_jacobian, 3), "): solves will be slower"));
  }
}

void run_hexmesh(const Choices& choices, Run& run) {
  const BreastGeometry geometry = read_geometry(choices.geometry);
  const LabelVolume labels = read_labels(choices.labels);
  const double skin_mm = choices.skin == "measured" ? measured_skin_thickness(labels, geometry)
                                                    : parse_skin_thickness(choices.skin);
  BodyMeshReport body;
  HexMesh mesh;
  {
    Timer::Scope phase(run.timer(), "mesh");
    mesh = body_mesh(geometry, choices.mesh_options(skin_mm), &body);
  }
  TissueReport tissue;
  {
    Timer::Scope phase(run.timer(), "tissue");
    tissue = assign_tissue(labels, mesh);
  }
  if (choices.skin_as == "membrane") set_membrane_skin(skin_mm, mesh);
  add_nipple(mesh);
  if (const auto tumour = choose_tumour(choices, labels, run)) {
    add_tumour(*tumour, mesh);
    run.report().set("tumour", tumour->origin);
  }
  report_mesh(mesh, body, tissue, run);
  run.report().set("skin_mm", skin_mm);
  mesh.history = run.history({{choices.geometry, geometry.content_sha256, &geometry.history},
                              {choices.labels, labels.content_sha256, &labels.history}});
  mesh.wall_seconds = run.seconds();
  write_mesh(choices.mesh, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  Choices choices;
  Tool tool("hexmesh", "hexahedral mesh of a breast from its surface sheets and labels");
  tool.describe(
      "Fills the body between the skin and chest-wall sheets with hexahedra: a half O-grid (dome) "
      "that "
      "keeps its shape on pendulous breasts, or the warped cuboid of the paper. Nodes slide on the "
      "sheets while the mesh is untangled and smoothed. Each element takes its tissue from the "
      "voxels "
      "in it. A folded mesh is never written.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section II-B");
  tool.cite("Garanzha et al. 2021, Foldover-free maps in 50 lines of code, ACM Trans Graph 40(4)");
  tool.input(choices.geometry, "GEOMETRY.vtkhdf", "sheets and rim (fit-hermite)");
  tool.input(choices.labels, "LABELS.vtkhdf", "tissue per voxel (segment)");
  tool.output(choices.mesh, "MESH.vtkhdf", "mesh of the imaged shape");
  tool.choice(choices.shape, "--template", {"dome", "cuboid"}, "arrangement of the elements");
  tool.integer(choices.elements, "--elements", "N",
               "about N^3 elements; 16 gives 4000 (dome) or the paper's 4096 (cuboid)", 4, 64);
  tool.numbers(choices.dome, "--dome", "n,l,m,k", 4,
               "core n x n x l elements, m layers round it, k rows of cut faces");
  tool.text(choices.skin, "--skin", "MM|0|measured", "thickness of the skin in mm");
  tool.choice(choices.skin_as, "--skin-as", {"membrane", "layer"},
              "skin as a membrane on the outer faces or as the outermost layer of elements");
  tool.text(
      choices.tumour, "--tumour", "auto|none|x,y,z[:radius]|FILE",
      "tumour point in patient LPS mm; with a radius, elements inside become tumour; FILE is a "
      ".tsv with columns x_mm y_mm z_mm [radius_mm], or labels with tumour voxels");
  tool.check([&] { choices.check(); });
  tool.example("hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf",
               "about 4000 elements, skin as a membrane of 1.45 mm, artificial tumour");
  tool.example(
      "hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf --template cuboid --skin-as layer",
      "as in the paper: 4913 nodes, 4096 elements");
  return tool.main(argc, argv, [&](Run& run) { run_hexmesh(choices, run); });
}
