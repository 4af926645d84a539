// forward: the shape of a stress-free breast under gravity.
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
  std::filesystem::path reference, deformed;
  GravityChoices gravity{"supine", {}};
  MechanicsChoices mechanics;
  std::string estimate = "step";
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Finds the equilibrium of the breast under gravity, from its stress-free shape: "
      "hyperelastic, "
      "exactly incompressible unless --bulk-ratio is given, the chest wall held. Nodal gravity "
      "forces "
      "are those of the imaged shape, so that under the gravity of the scan the imaged shape comes "
      "back to rounding error.");
  tool.describe(
      "A solve that stops has exit code 3, writes nothing, and gives its reason in the report: "
      "iteration_limit, no_admissible_step, indefinite_tangent or folded_element.");
  tool.cite("Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), equation (5)");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.output(c.deformed, "DEFORMED.vtkhdf", "the same mesh under gravity");
  declare_gravity(tool, c.gravity, "direction of gravity");
  declare_mechanics(tool, c.mechanics);
  declare_estimate(tool, c.estimate);
  tool.example("forward reference.vtkhdf supine.vtkhdf", "lying on the back");
  tool.example("forward reference.vtkhdf prone.vtkhdf --posture prone --element q2p1",
               "back to the scanned posture, quadratic elements");
}

void run_forward(const Choices& c, Run& run) {
  MechanicsOptions options = mechanics_options(c.mechanics);
  options.estimate = estimate_from_name(c.estimate);
  HexMesh mesh = read_mesh(c.reference, {.reference = true});
  const std::string sha = mesh.content_sha256;
  if (options.element == Element::q2p1) mesh = raise_order(mesh);
  SolveSummary summary = solve_forward(mesh, c.gravity.vector(), options, run.progress());
  if (options.estimate == Estimate::q2) {
    estimate_by_second_solution(
        mesh, options, summary, [&](HexMesh& richer, const MechanicsOptions& same) {
          return solve_forward(richer, c.gravity.vector(), same, run.progress());
        });
  }
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  mesh.contact.reset();
  mesh.contact_pressure.clear();
  write_report(summary, mesh, options, run.report());
  tell_summary(run.report(), summary.timer, run.progress());
  for (const std::string& doubt : summary.doubts) run.warn(doubt);
  if (summary.converged() || c.mechanics.keep_unconverged) {
    const History before = mesh.history;
    mesh.history = run.history({{c.reference, sha, &before}});
    mesh.wall_seconds = run.seconds();
    write_mesh(c.deformed, mesh);
  }
  if (!summary.converged()) throw not_converged_error(summary.record.reason);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("forward", "the shape of a stress-free breast under gravity");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_forward(c, run); });
}
