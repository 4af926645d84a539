// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexmesh_options.hpp"

#include "cli/sibling.hpp"
#include "core/error.hpp"
#include "meshing/layers/muscle_layer.hpp"
#include "meshing/layers/surrounding_layers.hpp"
#include "meshing/skin.hpp"
#include "meshing/tumour.hpp"

namespace breast {

BodyMeshOptions MeshChoices::mesh_options(double skin_mm) const {
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

void MeshChoices::check() const {
  parse_tissue_codes(foreign.codes);
  if (!dome.empty() && shape == "cuboid") throw input_error("--dome needs --template dome");
  if (!tetrahedra.empty() && tetrahedra.extension() != ".vtu")
    throw input_error("--tetrahedra ", tetrahedra.string(), ": must end in .vtu");
  if (!tetrahedra.empty() && skin_as == "layer")
    throw input_error(
        "--tetrahedra needs --skin-as membrane, because its elements are thicker than a layer "
        "of skin");
  if (surroundings_mm > 0 && skin_as == "layer")
    throw input_error(
        "--surroundings needs --skin-as membrane: the tissue around the breast has no layer of skin");
  if (!tetrahedra.empty())
    require_sibling("tetrahedra", "--tetrahedra", "it needs the package libcgal-dev");
  if (skin != "measured") parse_skin_thickness(skin);
  if (muscle != "measured") parse_muscle_thickness(muscle);
  mesh_options(1);
  if (tumour != "auto" && tumour != "none" && !std::filesystem::exists(tumour))
    parse_tumour(tumour);
}

void declare_hexmesh(Tool& tool, MeshChoices& choices) {
  tool.describe(
      "Fills the body between the skin and chest-wall sheets with hexahedra: a half O-grid "
      "(dome) that keeps its shape on pendulous breasts, or the warped cuboid of the paper. "
      "Nodes slide on the sheets while the mesh is untangled and smoothed. Each element takes "
      "its tissue from the voxels inside it. Where the mesh that was asked for has a scaled "
      "Jacobian below 0.2, others are tried in this order: template (a dome for a folded cuboid), "
      "layers, smoothing, untangling, elements; the report and one line say which step was taken. A "
      "mesh with folded elements is never written.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), section II-B");
  tool.cite("Garanzha et al. 2021, Foldover-free maps in 50 lines of code, ACM Trans Graph 40(4)");
  tool.input(choices.geometry, "GEOMETRY.vtkhdf", "sheets and rim (fit-hermite)");
  tool.input(
      choices.labels, "LABELS.vtkhdf",
      "tissue per voxel (segment), a segmentation of 3D Slicer (.seg.nrrd) or a label volume "
      "(.nrrd, .nii, .mha)");
  tool.output(choices.mesh, "MESH.vtkhdf", "mesh of the imaged shape");
  tool.choice(choices.shape, "--template", {"dome", "cuboid"}, "arrangement of the elements");
  tool.integer(choices.elements, "--elements", "N",
               "about N^3 elements; 16 gives 4000 (dome) or the paper's 4096 (cuboid)", 4, 64);
  tool.numbers(choices.dome, "--dome", "n,l,m,k", 4,
               "numbers of elements in the dome: n x n x l in the core, m layers around it, k "
               "rows of cut faces");
  tool.integer(choices.order, "--order", "1|2",
               "1: 8-node elements with bilinear faces; 2: 27-node elements whose boundary "
               "nodes lie on the sheets and the cut (for --element q2p1)",
               1, 2);
  tool.text(choices.skin, "--skin", "MM|0|measured",
            "thickness of the skin in mm, from 0.1 to 10; 0 for no skin; measured for the "
            "thickness found in the scan");
  tool.choice(choices.skin_as, "--skin-as", {"membrane", "layer"},
              "model of the skin: a membrane on the outer faces, or the outermost layer of "
              "elements");
  tool.text(
      choices.muscle, "--muscle", "MM|0|measured",
      "thickness of a layer of muscle between the chest wall in the scan and the ribs, on which the "
      "body then slides; 0 for no muscle; measured for the thickness in labels that show the "
      "back of the muscle, otherwise 8 mm");
  tool.number(
      choices.surroundings_mm, "--surroundings", "MM",
      "width of the tissue around the breast that is meshed with it, beyond the lateral cut; it "
      "has the law of fat and the label other, and holds the breast instead of supports at the "
      "cut; plates and mammograms leave it out",
      0, most_surroundings_mm);
  tool.text(
      choices.tumour, "--tumour", "auto|none|x,y,z[:radius]|FILE",
      "position of the tumour in LPS mm; with a radius, the elements inside it become tumour. "
      "FILE is a .tsv with columns x_mm y_mm z_mm [radius_mm], a point of 3D Slicer (.mrk.json or .fcsv: "
      "the one labelled tumour, or the only one), or a label volume with tumour voxels, or a mask of "
      "the tumour (one value besides 0). auto "
      "takes the tumour of the labels; if they have none, it places an artificial one at the "
      "edge of the fibroglandular tissue (landmark artificial_tumour)");
  tool.input_file(
      choices.landmarks, "--landmarks", "FILE",
      "landmarks to follow through all shapes: points of 3D Slicer (.mrk.json or .fcsv, LPS or RAS) with "
      "their labels as names, or a .tsv with columns name x_mm y_mm z_mm (LPS); they may lie at "
      "most 10 mm outside the mesh");
  declare_label_choices(tool, "hexmesh", choices.foreign);
  tool.flag(
      choices.accept_mismatch, "--accept-mismatch",
      "mesh a geometry even if it does not agree with the labels, that is, if its skin or its "
      "chest wall lies elsewhere than theirs (2 mm in the mean, or 5 mm over a twentieth of its "
      "area); such a geometry is refused otherwise");
  tool.output_file(choices.surface, "--surface", "OUT.vtp",
                   "closed boundary of the mesh as triangles, with a scalar part (0 skin, 1 "
                   "lateral cut, 2 chest wall)");
  tool.output_file(choices.tetrahedra, "--tetrahedra", "OUT.vtu",
                   "tetrahedral mesh of the same body for other solvers, with about the edge "
                   "length of the hexahedra, and its boundary triangles; it has a tissue per "
                   "tetrahedron and a part per triangle as in --surface");
  tool.topic("elements", {"--template", "--elements", "--dome", "--order", "--accept-mismatch"});
  tool.topic("body", {"--skin", "--skin-as", "--muscle", "--surroundings"});
  tool.topic("points to follow", {"--tumour", "--landmarks"});
  tool.topic("further outputs", {"--surface", "--tetrahedra"});
  tool.basic({"--elements", "--order", "--skin", "--muscle", "--surroundings", "--tumour",
              "--landmarks", "--code", "--side"});
  tool.check([&] { choices.check(); });
  tool.example("hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf",
               "about 4000 elements, skin as a membrane of 1.45 mm, artificial tumour");
  tool.example(
      "hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf --template cuboid --skin-as layer",
      "as in the paper: 4913 nodes, 4096 elements");
}

}  // namespace breast
