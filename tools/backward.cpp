// SPDX-License-Identifier: GPL-3.0-or-later
// backward: the stress-free shape of an imaged breast.
#include <optional>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/closure.hpp"
#include "mechanics/estimate/second_solution.hpp"
#include "mechanics_run.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, reference;
  GravityChoices gravity{"prone", {}};
  MechanicsChoices mechanics{{}, default_material_set};
  std::string estimate = "step";
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Finds the stress-free (reference) shape of the breast: the shape that gravity deforms "
      "into the imaged one. The equations are those of forward with the reference shape as the "
      "unknown; they are solved by Newton's method with exact derivatives.");
  tool.describe(
      "If there is no solution, the exit code is 3, nothing is written, and the report's entry "
      "reason says why: no_stress_free_body (the solution path ends before the full load, so "
      "that gravity cannot produce the imaged shape with these tissues), unstable_equilibrium "
      "(a stress-free body exists, but the imaged shape is not a stable equilibrium of it), "
      "not_closed (see below), or the point at which the solution method gave up (iteration_limit, no_admissible_step, "
      "folded_element). stiffness_factor_needed is the factor by which all tissues must be "
      "stiffened for a stable body to exist; stability/change and stability/factor give the "
      "smallest change of one tissue, the skin, the wall or the cut that is sufficient, "
      "confirmed by solving again.");
  tool.describe(
      "Afterwards the forward problem is solved from the shape found; closure_mm in the report "
      "is the largest distance between its nodes and those of the imaged shape. Above 1e-6 mm, or if "
      "forward finds no solution, the reason is not_closed: gravity leads from this stress-free shape "
      "to another equilibrium than the scan.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), equation (6)");
  tool.input(c.mesh, "MESH.vtkhdf", "mesh of the imaged shape (hexmesh)");
  tool.output(c.reference, "REFERENCE.vtkhdf", "the same mesh, stress-free");
  declare_gravity(tool, c.gravity, "direction of gravity during the scan");
  declare_mechanics(tool, c.mechanics, "MESH");
  declare_estimate(tool, c.estimate);
  tool.basic({"--posture", "--gravity", "--materials", "--scale", "--element", "--wall", "--cut"});
  tool.example("backward mesh.vtkhdf reference.vtkhdf",
               "prone scan, a breast that slides on its chest wall");
  tool.example("backward mesh.vtkhdf reference.vtkhdf --materials seed2008",
               "the model of the paper, held at the chest wall");
  tool.example("backward mesh.vtkhdf reference.vtkhdf --materials mira2018 --scale fat=120",
               "softer materials identified in vivo, with fat 20 % stiffer");
}

// Solves forward from the shape found, and judges `backward` by the result.
void check_closure(HexMesh mesh, const Vec3& gravity, const MechanicsOptions& options, Run& run,
                   Equilibrium& backward) {
  store(backward, mesh);
  Equilibrium again;
  {
    Timer::Scope phase(backward.timer, "closure");
    again = solve_forward(mesh, gravity, options, run.progress());
  }
  const std::optional<double> closure = judge_closure(again, mesh, backward);
  if (!closure) return;
  run.report().set("closure_mm", *closure);
  backward.timer.move("closure", "error estimate", again.timer.seconds("error estimate"));
  // Both directions share these data of the equilibrium.
  backward.error_estimate_mm = again.error_estimate_mm;
  backward.landmark_error_mm = again.landmark_error_mm;
  backward.error_estimate_how = again.error_estimate_how;
}

void run_backward(const Choices& c, Run& run) {
  const Vec3 gravity = c.gravity.vector();
  MechanicsRun mechanics(run, c.mechanics, c.estimate, c.mesh, read_mesh(c.mesh));
  const HexMesh& mesh = mechanics.mesh();
  Equilibrium found = solve_backward(mesh, gravity, mechanics.options(), run.progress());
  if (found.converged()) check_closure(mesh, gravity, mechanics.options(), run, found);
  if (mechanics.options().estimate == Estimate::q2) {
    estimate_by_second_solution(mesh, mechanics.options(), found,
                                [&](const HexMesh& richer, const MechanicsOptions& same) {
                                  return solve_backward(richer, gravity, same, run.progress());
                                });
  }
  write_report(found, mesh, mechanics.options(), run.report());
  mechanics.finish(found, c.reference);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("backward", "the stress-free shape of an imaged breast");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_backward(c, run); });
}
