// SPDX-License-Identifier: GPL-3.0-or-later
// phantom-mesh: one breast of the phantom on a finer mesh of 8-node elements,
// stress-free, prone, supine.
#include <algorithm>
#include <cmath>

#include "cli/tool.hpp"
#include "core/units.hpp"
#include "io/mesh_file.hpp"
#include "material/material_set.hpp"
#include "mechanics/mechanics.hpp"
#include "phantom/chest/rib_spline.hpp"
#include "phantom/postures.hpp"
#include "phantom/random.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, supine, set;
  std::string preset = "paper", side = "left", materials;
  int seed = 1;
  double level = 2, coarse = 1;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Meshes the same breast as `phantom`, with the same shape, fibroglandular tissue, materials "
      "and landmarks, but with 8-node elements: 4280 at level 1, and 34240 at level 2 (eight "
      "times as many as in the chain's mesh); a sliding breast has a tenth more. The prone and "
      "supine shapes are solved as in the phantom. The breast is either fixed at the wall and the "
      "cut, or it slides on the ribs, which are then the chest-wall surface of the mesh. "
      "`compress` continues from the prone mesh, which states its model. The difference between two levels estimates the error of the finer one "
      "(truth-table).");
  tool.output(c.mesh, "PRONE.vtkhdf", "the prone mesh with its stress-free reference");
  tool.output_file(c.supine, "--supine", "SUPINE.vtkhdf", "write the supine shape to this file");
  tool.choice(c.preset, "--preset", preset_names(), "kind of breast, as in phantom");
  tool.integer(c.seed, "--seed", "N", "random seed, as in phantom", 0, 1000000000);
  tool.choice(c.side, "--side", {"left", "right"}, "which breast");
  tool.number(c.level, "--level", "L", "level of refinement; the mesh has about 4280 L^3 elements",
              0.5, 4);
  tool.text(c.materials, "--materials", "NAME|FILE",
            "material set, as in phantom (default: that of the preset)");
  tool.number(
      c.coarse, "--coarse", "FACTOR",
      "coarsening of the phantom's own mesh, as in phantom: its landmarks depend on that mesh", 1,
      8);
  tool.output_file(
      c.set, "--set", "SET.tsv",
      "also write the material set of the body; for a sliding breast with its supports of wall "
      "and cut");
  tool.example("phantom-mesh left-fine.vtkhdf --supine left-fine-supine.vtkhdf --level 2",
               "the left breast of the phantom `paper` for `compress`");
  tool.example("phantom-mesh body.vtkhdf --preset average --level 1",
               "a breast that slides, for `compress --image-edge auto`");
}

// Mesh parameters that differ from those of phantom and hexmesh, with `level` times as many
// elements along every edge.
MeshParameters mesh_of_level(double level, bool slides) {
  const auto times = [level](double n) { return std::max(1, int(std::lround(n * level))); };
  return {2 * times(5), times(5), times(slides ? 5 : 3), times(4), times(7), 1};
}

void run_phantom_mesh(const Choices& c, Run& run) {
  PhantomParameters parameters = phantom_preset(c.preset, std::uint64_t(c.seed));
  if (!c.materials.empty()) parameters.body.materials = c.materials;
  const MaterialSet materials = body_materials(parameters.body);
  const Side side = side_from_name(c.side);
  const Torso torso(parameters.torso, mix(parameters.seed, 301));
  run.progress().update("shape", -1, "the phantom's own mesh, for its landmarks");
  if (c.coarse >= 2) parameters.mesh = coarse_mesh(parameters);
  const HexMesh imaged = PhantomBreast(parameters, torso, side).mesh;
  parameters.mesh = mesh_of_level(c.level, parameters.body.slides);
  PhantomBreast breast(parameters, torso, side);
  HexMesh& mesh = breast.mesh;
  if (parameters.body.slides) {
    mesh.geometry.emplace().side = side;
    mesh.geometry->thorax = rib_spline(parameters.torso);
  }
  carry_landmarks(imaged, mesh);
  TruthError error;
  const Postures postures = [&] {
    Timer::Scope phase(run.timer(), "mechanics");
    return solve_breast(breast, parameters, materials, error, run.progress());
  }();
  Report& report = run.report();
  report.set("elements", mesh.elements());
  report.set("unknowns", postures.prone.unknowns);
  report.set("newton_iterations", postures.prone.newton_iterations);
  report.set("residual", postures.prone.residual);
  report.set("min_det_F", postures.prone.min_det_F);
  report.set("imaged_gap_mm", postures.imaged_gap);
  report.set("error_estimate_mm", error.worst());
  report.set("error_estimate_by", "largest landmark distance to a mesh of half the resolution");
  mesh.history = run.history({});
  mesh.reference = postures.stress_free;
  mesh.pressure = postures.pressure;
  mesh.gravity = posture_gravity(Posture::prone);
  mesh.model = postures.model;
  mesh.solve = postures.prone.record;
  write_mesh(c.mesh, mesh);
  if (!c.set.empty()) write_table(c.set, material_table(materials));
  if (c.supine.empty()) return;
  mesh.points = postures.supine;
  // These belong to the prone shape.
  mesh.pressure.clear(), mesh.det_F.clear(), mesh.scaled_jacobian.clear();
  mesh.gravity = posture_gravity(Posture::supine);
  mesh.solve = postures.supine_solve.record;
  write_mesh(c.supine, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("phantom-mesh", "a breast of the phantom on a finer mesh");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_phantom_mesh(c, run); });
}
