// SPDX-License-Identifier: GPL-3.0-or-later
// forward-mpi: forward on several processes, for meshes that need more memory or time than one
// machine offers.
#include <optional>

#include "cli/mechanics_options.hpp"
#include "distributed/distributed.hpp"
#include "io/mesh_file.hpp"
#include "mechanics_run.hpp"
#include "ranks_main.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path reference, deformed;
  GravityChoices gravity{"supine", {}};
  MechanicsChoices mechanics;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Solves the same problem as forward, with the same terms and the same Newton method, on the "
      "processes that mpirun starts. PT-Scotch distributes the elements over the processes. PETSc "
      "solves the linear systems by flexible GMRES, with algebraic multigrid (GAMG) for the "
      "displacements and an approximation of the Schur complement for the pressures. The first "
      "process reads and writes the files, which are the same as those of forward.");
  tool.describe(
      "There is no estimate of the discretisation error and no search for a change that would "
      "give a stable equilibrium. --threads is the number of threads of all processes together. "
      "The environment variable PETSC_OPTIONS changes PETSc's settings, for example "
      "-breast_ksp_monitor.");
  tool.cite("Balay et al. 2022, PETSc/TAO Users Manual, ANL-21/39 revision 3.18");
  tool.input(c.reference, "REFERENCE.vtkhdf", "stress-free mesh (backward)");
  tool.output(c.deformed, "DEFORMED.vtkhdf", "the same mesh under gravity");
  declare_gravity(tool, c.gravity, "direction of gravity");
  declare_mechanics(tool, c.mechanics, "REFERENCE");
  tool.basic({"--posture", "--gravity", "--materials", "--scale", "--element", "--wall", "--cut"});
  tool.example("mpirun -n 16 forward-mpi reference.vtkhdf supine.vtkhdf", "on 16 processes");
}

void run_forward(const Choices& c, Run& run, const Ranks& ranks) {
  std::optional<MechanicsRun> mechanics;
  ranks.together([&] {
    if (!ranks.root()) return;
    mechanics.emplace(run, c.mechanics, "none", c.reference,
                      read_mesh(c.reference, {.reference = true}));
  });
  const MechanicsOptions options =
      shared_options(ranks, mechanics ? mechanics->options() : MechanicsOptions{});
  const HexMesh none;
  const HexMesh& mesh = mechanics ? mechanics->mesh() : none;
  Equilibrium found = solve_forward_on(ranks, mesh, c.gravity.vector(), options, run.progress());
  run.report().set("ranks", ranks.size());
  ranks.together([&] {
    if (!mechanics) return;
    write_report(found, mesh, options, run.report());
    mechanics->finish(found, c.deformed);
  });
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("forward-mpi", "forward on several processes, for very large meshes");
  declare(tool, c);
  return ranks_main(tool, argc, argv,
                    [&c](Run& run, const Ranks& ranks) { run_forward(c, run, ranks); });
}
