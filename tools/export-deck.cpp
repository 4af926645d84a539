// SPDX-License-Identifier: GPL-3.0-or-later
// export-deck: writes a model for FEBio or CalculiX, and reads their result back as a mesh.
#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "export/deck/calculix.hpp"
#include "export/deck/febio.hpp"
#include "export/deck/report.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/model.hpp"
#include "mesh/element_order.hpp"
#include "mesh/quality.hpp"
#include "solved_model.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

// Default bulk ratio, with which the volume is preserved to about a thousandth.
constexpr double default_bulk_ratio = 1000;

struct Choices {
  std::filesystem::path reference, out, result, base;
  GravityChoices gravity{"supine", {}};
  MechanicsChoices mechanics;
  std::string calculix_element;
  bool without_skin = false;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Writes the problem that forward would solve (stress-free shape, material laws, held "
      "nodes, gravity) as an input file of CalculiX or Abaqus (OUT.inp) or of FEBio 4 "
      "(OUT.feb), with the same nodes, elements and laws in the isochoric invariants. These "
      "programs preserve volume by a bulk modulus, --bulk-ratio (1000 if it is not given). They "
      "have no membrane skin: mesh with hexmesh --skin-as layer or --skin 0, or omit the skin "
      "with --without-skin. Only FEBio has law (10). CalculiX receives gravity as the nodal "
      "forces that forward uses, FEBio as a body force per unit mass.");
  tool.describe(
      "With --read-back RESULT the tool writes OUT.vtkhdf instead: the mesh with the "
      "displacements that the other program found, for probe and render. --base compares it "
      "node by node with another shape of the same mesh.");
  tool.cite(
      "Dhondt 2004, The Finite Element Method for Three-Dimensional Thermomechanical "
      "Applications (CalculiX); Maas et al. 2012, J Biomech Eng 134(1) (FEBio)");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.output(c.out, "OUT.inp|OUT.feb|OUT.vtkhdf",
              "input file of the other program, or with --read-back the displaced mesh");
  declare_gravity(tool, c.gravity, "direction of gravity");
  declare_mechanics(tool, c.mechanics, "REFERENCE");
  tool.flag(c.without_skin, "--without-skin", "omit a membrane skin from the model");
  tool.text(
      c.calculix_element, "--calculix-element", "TYPE",
      "element type: C3D8I, C3D8 or C3D8R, and with 27-node elements C3D20R or C3D20 (default: "
      "C3D8I or C3D20R)");
  tool.input_file(c.result, "--read-back", "RESULT",
                  "displacements of the nodes as the other program wrote them: .frd or .dat "
                  "(CalculiX), .log (FEBio)");
  tool.input_file(c.base, "--base", "FILE.vtkhdf",
                  "with --read-back, the mesh with which the result is compared node by node");
  tool.basic({"--posture", "--gravity", "--materials", "--element", "--bulk-ratio", "--wall",
              "--cut", "--without-skin", "--calculix-element", "--read-back", "--base"});
  tool.check([&c] {
    const std::string ending = c.out.extension().string();
    const bool mesh = ending == ".vtkhdf";
    if (!mesh && ending != ".inp" && ending != ".feb") {
      throw input_error(c.out.filename().string(), ": its ending must be .inp, .feb or .vtkhdf");
    }
    if (mesh == c.result.empty()) {
      throw input_error(mesh ? "OUT.vtkhdf needs --read-back RESULT"
                             : "--read-back writes a mesh: the output must be OUT.vtkhdf");
    }
    if (!c.base.empty() && c.result.empty()) throw input_error("--base needs --read-back RESULT");
  });
  tool.example(
      "export-deck reference.vtkhdf supine.inp --bulk-ratio 1000 --without-skin",
      "input file of CalculiX for a breast that was solved with a held wall; then run: ccx supine");
  tool.example(
      "export-deck reference.vtkhdf supine.inp --wall held --cut free --bulk-ratio 1000 --without-skin",
      "the same for a breast that slides on its chest wall, held instead");
  tool.example(
      "export-deck reference.vtkhdf supine-ccx.vtkhdf --read-back supine.frd "
      "--base supine.vtkhdf",
      "CalculiX's solution as a mesh, and its distance from that of forward");
}

// The model of the other program, which cannot be exactly incompressible.
MechanicsOptions deck_model(const Choices& c, const HexMesh& mesh, Run& run) {
  MechanicsOptions options = model_for(c.mechanics, c.reference, mesh, run);
  if (!(options.bulk_ratio > 0)) {
    options.bulk_ratio = default_bulk_ratio;
    run.warn(
        message("an exactly incompressible law cannot be written: the ratio of bulk to "
                "shear modulus is ",
                default_bulk_ratio, " instead (see --bulk-ratio)"));
  }
  return options;
}

DeckScene scene_of(const Choices& c, const HexMesh& mesh, const MechanicsOptions& options,
                   Run& run) {
  if (mesh.skin_model == SkinModel::membrane && c.without_skin) {
    run.warn("the membrane skin is omitted");
  }
  return deck_scene(mesh, options, c.gravity.vector(), c.without_skin);
}

void write_deck(const Choices& c, const HexMesh& mesh, const MechanicsOptions& options, Run& run) {
  const DeckScene scene = scene_of(c, mesh, options, run);
  const bool calculix = c.out.extension() == ".inp";
  const std::string element = !c.calculix_element.empty()    ? c.calculix_element
                              : scene.nodes_per_element == 8 ? "C3D8I"
                                                             : "C3D20R";
  write_text(c.out, calculix ? calculix_deck(scene, element) : febio_deck(scene));
  write_report(scene, calculix ? element : message("hex", scene.nodes_per_element), run.report());
}

void read_back(const Choices& c, HexMesh mesh, const MechanicsOptions& options, Run& run) {
  const DeckResult result = read_deck_result(c.result, int(deck_nodes(mesh).size()));
  apply_displacement(mesh, result.displacement);
  mesh.gravity = c.gravity.vector();
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  mesh.model = model_text(options);
  mesh.solve = SolveRecord{SolveStatus::converged, "solved by another program", {}};
  if (result.reaction)
    write_balance(scene_of(c, mesh, options, run), *result.reaction, run.report());
  if (!c.base.empty()) {
    const HexMesh base = read_mesh(c.base);
    pairs_of("export-deck", run)
        .check("REFERENCE", origin_of(c.reference, mesh), "--base", origin_of(c.base, base));
    const NodeDifference difference = node_difference(mesh, base);
    run.print(write_difference(difference, mesh, run.report()).text());
  }
  const History before = mesh.history;
  mesh.history = run.history({{c.reference, mesh.content_sha256, &before}});
  mesh.wall_seconds = run.seconds();
  write_mesh(c.out, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("export-deck",
            "write a model for FEBio or CalculiX, and read their result back as "
            "a mesh");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) {
    HexMesh mesh = read_mesh(c.reference, {.reference = true});
    const MechanicsOptions options = deck_model(c, mesh, run);
    if (options.element == Element::q2p1) mesh = raise_order(mesh);
    c.result.empty() ? write_deck(c, mesh, options, run)
                     : read_back(c, std::move(mesh), options, run);
  });
}
