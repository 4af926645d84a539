// SPDX-License-Identifier: GPL-3.0-or-later
// sensitivity: how a deformed breast depends on materials, gravity, skin and plates.
#include <optional>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/derivative_file.hpp"
#include "mechanics/options.hpp"
#include "sensitivity/results.hpp"
#include "solved_model.hpp"
#include "tool_pairs.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path reference, state, out, table;
  std::string parameters = "main";
  bool adjoint = false;
  GravityChoices imaged{"prone", {}};
  MechanicsChoices mechanics;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Computes the derivatives of all nodal positions and of the landmarks with respect to "
      "stiffness, single material constants, density, directions of gravity, skin thickness and "
      "the plates' pose, through backward and then forward or compress: the stress-free shape "
      "changes with every parameter so that the imaged shape remains the same. No nonlinear "
      "problem is solved again; each state is factorised once, and every parameter costs two "
      "linear solves.");
  tool.describe(
      "Parameters: a tissue's name (stiffness scale), TISSUE.CONSTANT as laws names them "
      "(fat.a10), density, TISSUE.density, skin_thickness, gravity_x, _y, _z (gravity of the "
      "state turned towards that axis), imaged_gravity_x ... (of the scan), and for a "
      "compressed state thickness, standoff and angle of the plates. 'main' means all "
      "parameters except single constants and densities; 'all' means every one. Derivatives are "
      "in mm per unit relative change (d x / d ln m), per degree or per mm. The set of nodes in "
      "contact is kept; where it is about to change, the derivatives are one-sided. The "
      "thickness, position and orientation of the plates are fixed except for the parameter "
      "that moves them. With friction, the bounds of the tangential tractions and the set of "
      "slipping nodes are kept.");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.input(c.state, "STATE.vtkhdf", "deformed mesh (forward or compress)");
  tool.output(c.out, "OUT.vtkhdf",
              "STATE with additional arrays derivative_PARAMETER on nodes, or "
              "influence_LANDMARK on elements");
  tool.text(c.parameters, "--parameters", "LIST", "main, all, or names separated by commas");
  tool.flag(c.adjoint, "--adjoint",
            "use the adjoint method, for the landmarks only: six linear solves per landmark for "
            "any number of parameters, and also the influence of every element's stiffness (mm "
            "of displacement per relative change)");
  tool.output_file(c.table, "--table", "OUT.tsv",
                   "table of landmark, parameter, derivative, d ln|u| of the displacement from "
                   "the imaged position, and seconds (default: stdout)");
  declare_gravity(tool, c.imaged, "direction of gravity during the scan, as given to backward");
  declare_mechanics(tool, c.mechanics, "REFERENCE");
  tool.basic({"--parameters", "--adjoint", "--table", "--posture", "--gravity", "--materials",
              "--scale", "--element", "--wall", "--cut"});
  tool.cite(
      "Pathmanathan et al. 2008, IEEE Trans Biomed Eng 55(10), Tables III-VI (by solving again)");
  tool.example("sensitivity reference.vtkhdf supine.vtkhdf supine-sensitivity.vtkhdf",
               "the parameters on which the supine prediction depends most");
  tool.example(
      "sensitivity reference.vtkhdf cc.vtkhdf out.vtkhdf --parameters all --adjoint --table cc.tsv",
      "every constant and every element, for the landmarks only");
}

void run_sensitivity(const Choices& c, Run& run) {
  const HexMesh reference = read_mesh(c.reference, {.reference = true});
  HexMesh mesh = read_mesh(c.state, {.reference = true});
  pairs_of("sensitivity", run)
      .check("REFERENCE", origin_of(c.reference, reference), "STATE", origin_of(c.state, mesh));
  const MechanicsOptions options = model_for(c.mechanics, c.reference, reference, run);
  warn_of_differences(options, c.state, mesh, run);
  const auto parameters =
      pick_parameters(all_parameters(reference, mesh, options, c.imaged.vector()), c.parameters);
  const SensitivityChain chain = [&] {
    Timer::Scope phase(run.timer(), "factorisation");
    run.progress().update("factorisation", -1, "the scan's shape and the deformed one");
    return SensitivityChain(reference, mesh, reference.pressure, c.imaged.vector(), options);
  }();
  const SensitivityResults results = [&] {
    Timer::Scope phase(run.timer(), "derivatives");
    return (c.adjoint ? adjoint_results : tangent_results)(chain, parameters, mesh, run.report(),
                                                           run.progress());
  }();
  run.report().set("side", side_name(mesh.side));
  run.report().set("status", "converged");
  run.report().set("elements", mesh.elements());
  run.report().set("parameters", parameters.size());
  run.report().set("contacts", chain.contacts());
  run.report().set("residual", std::max(chain.imaged().residual(), chain.deformed().residual()));
  const History state_history = mesh.history;
  mesh.history = run.history({{c.reference, reference.content_sha256, &reference.history},
                              {c.state, mesh.content_sha256, &state_history}});
  mesh.wall_seconds = run.seconds();
  write_mesh(c.out, mesh, results.arrays);
  if (c.table.empty()) {
    run.print(results.table.text());
  } else {
    write_table(c.table, results.table);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("sensitivity", "how a deformed breast depends on materials, gravity, skin and plates");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_sensitivity(c, run); });
}
