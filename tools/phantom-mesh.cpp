// SPDX-License-Identifier: GPL-3.0-or-later
// phantom-mesh: one breast of the phantom on a finer mesh of 8-node elements,
// stress-free, prone, supine.
#include "cli/tool.hpp"
#include "core/units.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/mechanics.hpp"
#include "phantom/postures.hpp"
#include "phantom/random.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, supine;
  std::string preset = "paper", side = "left", materials;
  int seed = 1, level = 2;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Meshes the breast that `phantom` images, with the same shape, fibroglandular tissue, "
      "materials and landmarks, by 8-node elements: 4280 at level 1, 34240 at level 2 (eight "
      "times as many as in the chain's mesh). The prone and supine shapes are solved from the "
      "stress-free one with the lateral cut held, as in the phantom. `compress` continues from "
      "the prone mesh; the difference between two levels estimates the error of the finer one "
      "(truth-table).");
  tool.output(c.mesh, "PRONE.vtkhdf", "the prone mesh with its stress-free reference");
  tool.output_file(c.supine, "--supine", "SUPINE.vtkhdf", "write the supine shape to this file");
  tool.choice(c.preset, "--preset", preset_names(), "kind of breast, as in phantom");
  tool.integer(c.seed, "--seed", "N", "random seed, as in phantom", 0, 1000000000);
  tool.choice(c.side, "--side", {"left", "right"}, "which breast");
  tool.integer(c.level, "--level", "L", "level of refinement; the mesh has 4280 L^3 elements", 1,
               4);
  tool.text(c.materials, "--materials", "NAME|FILE",
            "material set, as in phantom (default: that of the preset)");
  tool.example("phantom-mesh left-fine.vtkhdf --supine left-fine-supine.vtkhdf --level 2",
               "the left breast of the default phantom for `compress --cut fixed`");
}

void run_phantom_mesh(const Choices& c, Run& run) {
  PhantomParameters parameters = phantom_preset(c.preset, std::uint64_t(c.seed));
  if (!c.materials.empty()) parameters.body.materials = c.materials;
  const MaterialSet materials = body_materials(parameters.body);
  const Side side = side_from_name(c.side);
  const Torso torso(parameters.torso, mix(parameters.seed, 301));
  run.progress().update("shape", -1, "the phantom's own mesh, for its landmarks");
  const HexMesh imaged = PhantomBreast(parameters, torso, side).mesh;
  const int level = c.level;
  parameters.mesh = {10 * level, 5 * level, 3 * level, 4 * level, 7 * level, 1};
  PhantomBreast breast(parameters, torso, side);
  HexMesh& mesh = breast.mesh;
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
  write_mesh(c.mesh, mesh);
  if (c.supine.empty()) return;
  mesh.points = postures.supine;
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
