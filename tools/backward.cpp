// backward: the stress-free shape of an imaged breast.
#include <algorithm>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/closing_summary.hpp"
#include "mechanics/options.hpp"
#include "mechanics/second_solution.hpp"
#include "mesh/element_order.hpp"
#include "mesh/quality.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, reference;
  GravityChoices gravity{"prone", {}};
  MechanicsChoices mechanics;
  std::string estimate = "step";
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Finds the shape the breast would have without gravity: the one that gravity deforms into "
      "the "
      "imaged shape. The equations are those of forward with the reference shape unknown, solved "
      "by "
      "Newton's method with exact derivatives.");
  tool.describe(
      "Without an answer the exit code is 3, nothing is written, and reason in the report says "
      "why: "
      "no_stress_free_body (the unloaded shapes end before the full load: gravity cannot make the "
      "imaged shape of these tissues), unstable_equilibrium (a body exists, but would not stay in "
      "the imaged shape), or where the solution method gave up (iteration_limit, "
      "no_admissible_step, folded_element). stiffness_factor_needed is how many times stiffer all "
      "tissues must be for a stable body.");
  tool.describe(
      "Afterwards the forward problem is solved from the shape found; closure_mm in the report is "
      "the "
      "largest distance of its nodes from the imaged shape.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), equation (6)");
  tool.input(c.mesh, "MESH.vtkhdf", "mesh of the imaged shape (hexmesh)");
  tool.output(c.reference, "REFERENCE.vtkhdf", "the same mesh, stress-free");
  declare_gravity(tool, c.gravity, "direction of gravity during the scan");
  declare_mechanics(tool, c.mechanics);
  declare_estimate(tool, c.estimate);
  tool.example("backward mesh.vtkhdf reference.vtkhdf", "prone scan, materials of the paper");
  tool.example("backward mesh.vtkhdf reference.vtkhdf --materials mira2018 --scale fat=120",
               "softer materials identified in vivo, fat 20 % stiffer");
}

// Largest distance (mm) of the imaged shape from what forward makes of the shape found.
void check_closure(const HexMesh& mesh, const Vec3& gravity, MechanicsOptions options, Run& run,
                   SolveSummary& backward) {
  HexMesh again = mesh;
  again.points = again.reference;
  SolveSummary summary;
  {
    Timer::Scope phase(backward.timer, "closure");
    summary = solve_forward(again, gravity, options, run.progress());
  }
  if (!summary.converged()) {
    run.warn("forward did not return to the imaged shape: " + summary.record.reason);
    return;
  }
  double worst = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    worst = std::max(worst, (again.points[i] - mesh.imaged[i]).norm());
  }
  run.report().set("closure_mm", worst);
  backward.timer.move("closure", "error estimate", summary.timer.seconds("error estimate"));
  // Of the equilibrium both directions share.
  backward.error_estimate_mm = summary.error_estimate_mm;
  backward.landmark_error_mm = summary.landmark_error_mm;
  backward.error_estimate_how = summary.error_estimate_how;
  if (worst > 1e-6) {
    run.warn(message("forward returns to the imaged shape only within ", worst,
                     " mm: another equilibrium is near"));
  }
}

void run_backward(const Choices& c, Run& run) {
  MechanicsOptions options = mechanics_options(c.mechanics);
  options.estimate = estimate_from_name(c.estimate);
  HexMesh mesh = read_mesh(c.mesh);
  const std::string sha = mesh.content_sha256;
  if (options.element == Element::q2p1) mesh = raise_order(mesh);
  mesh.contact.reset();
  mesh.contact_pressure.clear();
  SolveSummary summary = solve_backward(mesh, c.gravity.vector(), options, run.progress());
  if (summary.converged()) check_closure(mesh, c.gravity.vector(), options, run, summary);
  if (options.estimate == Estimate::q2) {
    estimate_by_second_solution(
        mesh, options, summary, [&](HexMesh& richer, const MechanicsOptions& same) {
          return solve_backward(richer, c.gravity.vector(), same, run.progress());
        });
  }
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  write_report(summary, mesh, options, run.report());
  tell_summary(run.report(), summary.timer, run.progress());
  for (const std::string& doubt : summary.doubts) run.warn(doubt);
  if (summary.converged() || c.mechanics.keep_unconverged) {
    const History before = mesh.history;
    mesh.history = run.history({{c.mesh, sha, &before}});
    mesh.wall_seconds = run.seconds();
    write_mesh(c.reference, mesh);
  }
  if (!summary.converged()) throw not_converged_error(summary.record.reason);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("backward", "the stress-free shape of an imaged breast");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_backward(c, run); });
}
