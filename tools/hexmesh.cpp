// hexmesh: hexahedral mesh of a breast from its Hermite geometry and its labels.
#include <cmath>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/tet_mesh_file.hpp"
#include "meshing/boundary_surface.hpp"
#include "meshing/report.hpp"
#include "meshing/skin.hpp"
#include "meshing/tumour.hpp"
#include "tetrahedra/delaunay.hpp"
#include "tetrahedra/report.hpp"
#include "tetrahedra/tissue.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path geometry, labels, mesh, surface, tetrahedra;
  std::string shape = "dome", skin = "1.45", skin_as = "membrane", tumour = "auto";
  int elements = 16, order = 1;
  std::vector<double> dome;

  BodyMeshOptions mesh_options(double skin_mm) const {
    BodyMeshOptions options;
    if (shape == "cuboid") {
      options.size = cuboid_size(elements);
    } else {
      options.size = dome.empty() ? dome_near(elements) : dome_of(dome);
    }
    options.order = order;
    options.skin_layer = skin_as == "layer" ? skin_mm : 0;
    return options;
  }
  void check() const {
    if (!dome.empty() && shape == "cuboid")
      throw input_error("--dome goes with --template dome only");
    if (!tetrahedra.empty() && tetrahedra.extension() != ".vtu")
      throw input_error("--tetrahedra ", tetrahedra.string(), ": must end in .vtu");
    if (!tetrahedra.empty() && skin_as == "layer")
      throw input_error(
          "--tetrahedra goes with --skin-as membrane: its elements are thicker than "
          "a layer of skin");
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

void write_for_others(const Choices& choices, const HexMesh& mesh, Run& run) {
  if (choices.surface.empty() && choices.tetrahedra.empty()) return;
  TriMesh surface = boundary_surface(mesh);
  surface.history = mesh.history;
  if (!choices.surface.empty()) write_surface(choices.surface, surface);
  if (choices.tetrahedra.empty()) return;
  Timer::Scope phase(run.timer(), "tetrahedra");
  const double volume = mesh_volume(mesh, mesh.points);
  TetMesh tetrahedra = delaunay_tetrahedra(surface, std::cbrt(volume / mesh.elements()));
  copy_tissue(mesh, tetrahedra);
  tetrahedra.history = mesh.history;
  write_report(tetrahedra, volume, run.report());
  write_tet_mesh(choices.tetrahedra, tetrahedra);
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
  const MeshQuality quality = mesh_quality(mesh, mesh.points);
  write_report(mesh, quality, body, tissue, run.report());
  for (const std::string& doubt : doubts(quality)) run.warn(doubt);
  run.report().set("skin_mm", skin_mm);
  mesh.history = run.history({{choices.geometry, geometry.content_sha256, &geometry.history},
                              {choices.labels, labels.content_sha256, &labels.history}});
  mesh.wall_seconds = run.seconds();
  write_for_others(choices, mesh, run);
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
  tool.integer(choices.order, "--order", "1|2",
               "8-node elements with flat faces, or 27-node ones whose boundary nodes lie on the "
               "sheets and the cut (for --element q2p1)",
               1, 2);
  tool.text(choices.skin, "--skin", "MM|0|measured", "thickness of the skin in mm");
  tool.choice(choices.skin_as, "--skin-as", {"membrane", "layer"},
              "skin as a membrane on the outer faces or as the outermost layer of elements");
  tool.text(
      choices.tumour, "--tumour", "auto|none|x,y,z[:radius]|FILE",
      "tumour point in patient LPS mm; with a radius, elements inside become tumour; FILE is a "
      ".tsv with columns x_mm y_mm z_mm [radius_mm], or labels with tumour voxels");
  tool.output_file(choices.surface, "--surface", "OUT.vtp",
                   "the mesh's closed boundary as triangles; scalar part: 0 skin, 1 lateral cut, 2 "
                   "chest wall");
  tool.output_file(choices.tetrahedra, "--tetrahedra", "OUT.vtu",
                   "tetrahedra of the same body for other solvers, about as long in edge as the "
                   "hexahedra, with the boundary's triangles; tissue per tetrahedron, part per "
                   "triangle as in --surface");
  tool.check([&] { choices.check(); });
  tool.example("hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf",
               "about 4000 elements, skin as a membrane of 1.45 mm, artificial tumour");
  tool.example(
      "hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf --template cuboid --skin-as layer",
      "as in the paper: 4913 nodes, 4096 elements");
  return tool.main(argc, argv, [&](Run& run) { run_hexmesh(choices, run); });
}
