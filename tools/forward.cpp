// SPDX-License-Identifier: GPL-3.0-or-later
// forward: the shape of a stress-free breast under gravity.
#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/estimate/second_solution.hpp"
#include "mechanics_run.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path reference, deformed;
  GravityChoices gravity{"supine", {}};
  MechanicsChoices mechanics;
  std::string estimate = "step";
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Finds the equilibrium of the breast under gravity from its stress-free shape. The "
      "tissues are hyperelastic, and exactly incompressible unless --bulk-ratio is given. The "
      "nodal gravity forces are those of the imaged shape, so that gravity in the direction of "
      "the scan reproduces the imaged shape to rounding error.");
  tool.describe(
      "If the solve does not converge, the exit code is 3, nothing is written, and the report's "
      "entry reason says why: unstable_equilibrium (the shape found is an equilibrium, but an "
      "unstable one), iteration_limit, no_admissible_step, indefinite_tangent, "
      "left_wall_surface or folded_element. stability/change and stability/factor give the "
      "smallest change of one tissue, the skin, the wall or the cut with which the same "
      "stress-free shape has a stable equilibrium, confirmed by solving again.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), equation (5)");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.output(c.deformed, "DEFORMED.vtkhdf", "the same mesh under gravity");
  declare_gravity(tool, c.gravity, "direction of gravity");
  declare_mechanics(tool, c.mechanics, "REFERENCE");
  declare_estimate(tool, c.estimate);
  tool.example("forward reference.vtkhdf supine.vtkhdf", "lying on the back");
  tool.example("forward reference.vtkhdf prone.vtkhdf --posture prone --element q2p1",
               "back to the scanned posture, with quadratic elements");
}

void run_forward(const Choices& c, Run& run) {
  MechanicsRun mechanics(run, c.mechanics, c.estimate, c.reference,
                         read_mesh(c.reference, {.reference = true}));
  const HexMesh& mesh = mechanics.mesh();
  Equilibrium found = solve_forward(mesh, c.gravity.vector(), mechanics.options(), run.progress());
  if (mechanics.options().estimate == Estimate::q2) {
    estimate_by_second_solution(
        mesh, mechanics.options(), found, [&](const HexMesh& richer, const MechanicsOptions& same) {
          return solve_forward(richer, c.gravity.vector(), same, run.progress());
        });
  }
  write_report(found, mesh, mechanics.options(), run.report());
  mechanics.finish(found, c.deformed);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("forward", "the shape of a stress-free breast under gravity");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_forward(c, run); });
}
