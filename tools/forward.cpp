// SPDX-License-Identifier: GPL-3.0-or-later
// forward: the shape of a stress-free breast under gravity.
#include <algorithm>
#include <optional>
#include <vector>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/estimate/second_solution.hpp"
#include "mechanics/turn.hpp"
#include "mechanics_run.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path reference, deformed;
  GravityChoices gravity{"supine", {}};
  MechanicsChoices mechanics;
  std::string estimate = "step";
  StatesChoice states;
  std::string states_from = "prone";
  Vec3 start() const { return posture_gravity(posture_from_name(states_from)); }
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
  declare_states(tool, c.states, "while gravity turns to its direction");
  std::vector<std::string> postures;
  for (const Posture posture : {Posture::prone, Posture::supine, Posture::upright})
    postures.emplace_back(posture_name(posture));
  tool.choice(
      c.states_from, "--states-from", postures,
      "posture at which --states begins; between opposite directions the patient rolls over "
      "the side of the breast");
  tool.basic({"--posture", "--gravity", "--materials", "--scale", "--element", "--wall", "--cut"});
  tool.check([&c] {
    if (c.states.number > 0 && (c.gravity.vector() - c.start()).norm() == 0)
      throw input_error("--states ", c.states.number, ": gravity does not turn from ",
                        c.states_from, " to the same direction; give another --states-from");
  });
  tool.example("forward reference.vtkhdf supine.vtkhdf", "lying on the back");
  tool.example("forward reference.vtkhdf supine.vtkhdf --states 13",
               "the turn from prone to supine in steps of 15 degrees, in supine-states");
  tool.example("forward reference.vtkhdf prone.vtkhdf --posture prone --element q2p1",
               "back to the scanned posture, with quadratic elements");
}

/// Largest distance between two shapes, mm.
double apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, (a[n] - b[n]).norm());
  return most;
}

/// Solves the states on the way to `result`, which is the last of them.
void solve_states(const Choices& c, const Equilibrium& result, MechanicsRun& mechanics,
                  StateSeries& series, Run& run) {
  constexpr double much_apart = 0.01;  // mm, far more than what the tolerance of the solves leaves
  const HexMesh& mesh = mechanics.mesh();
  std::vector<Equilibrium> states = solve_turn(mesh, c.start(), c.gravity.vector(), c.states.number,
                                               mechanics.options(), run.progress());
  if (!states.back().points.empty()) {
    const double away = apart(states.back().points, result.points);
    run.report().set("states/turned_to_result_mm", away);
    if (away > much_apart)
      run.warn(message("the equilibrium that the turn reaches is ", away,
                       " mm from the result: the breast has more than one under this gravity"));
  }
  states.back() = result;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double part = double(k) / double(states.size() - 1);
    const Vec3 gravity = turned_gravity(c.start(), c.gravity.vector(), mesh.side, part);
    mechanics.add_state(series, states[k],
                        {{"way_percent", 100 * part},
                         {"gravity_x_mm_s2", gravity.x()},
                         {"gravity_y_mm_s2", gravity.y()},
                         {"gravity_z_mm_s2", gravity.z()}});
  }
  mechanics.tell_states(states);
}

void run_forward(const Choices& c, Run& run) {
  MechanicsRun mechanics(run, c.mechanics, c.estimate, c.reference,
                         read_mesh(c.reference, {.reference = true}));
  const HexMesh& mesh = mechanics.mesh();
  std::optional<StateSeries> states = c.states.series(c.deformed, mesh);
  Equilibrium found = solve_forward(mesh, c.gravity.vector(), mechanics.options(), run.progress());
  if (mechanics.options().estimate == Estimate::q2) {
    estimate_by_second_solution(
        mesh, mechanics.options(), found, [&](const HexMesh& richer, const MechanicsOptions& same) {
          return solve_forward(richer, c.gravity.vector(), same, run.progress());
        });
  }
  write_report(found, mesh, mechanics.options(), run.report());
  const bool on_the_way = states && found.converged();
  if (on_the_way) solve_states(c, found, mechanics, *states, run);
  mechanics.finish(found, c.deformed, false, {}, on_the_way ? &*states : nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("forward", "the shape of a stress-free breast under gravity");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_forward(c, run); });
}
