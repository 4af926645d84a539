// SPDX-License-Identifier: GPL-3.0-or-later
// backward-mpi: backward on several processes, for meshes that need more memory or time than one
// machine offers.
#include <optional>

#include "cli/mechanics_options.hpp"
#include "core/error.hpp"
#include "distributed/distributed.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/closure.hpp"
#include "mechanics_run.hpp"
#include "ranks_main.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, reference;
  GravityChoices gravity{"prone", {}};
  MechanicsChoices mechanics{{}, default_material_set};
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Solves the same problem as backward, with the same terms and the same Newton method, on "
      "the processes that mpirun starts (see forward-mpi). The linearised inverse problem is "
      "unsymmetric; its product with a vector is computed element by element, and the multigrid "
      "of the forward problem preconditions it.");
  tool.describe(
      "Afterwards the forward problem is solved from the shape found; closure_mm in the report is "
      "the largest distance of its nodes from the imaged shape. Above 1e-6 mm the reason is "
      "not_closed, as in backward. There is no estimate of the "
      "discretisation error. If there is no solution, neither stiffness_factor_needed nor the "
      "change that would give one is computed; use backward on a coarser mesh for these.");
  tool.cite("Balay et al. 2022, PETSc/TAO Users Manual, ANL-21/39 revision 3.18");
  tool.input(c.mesh, "MESH.vtkhdf", "mesh of the imaged shape (hexmesh)");
  tool.output(c.reference, "REFERENCE.vtkhdf", "the same mesh, stress-free");
  declare_gravity(tool, c.gravity, "direction of gravity during the scan");
  declare_mechanics(tool, c.mechanics, "MESH");
  tool.basic({"--posture", "--gravity", "--materials", "--scale", "--element", "--wall", "--cut"});
  tool.example("mpirun -n 16 backward-mpi mesh.vtkhdf reference.vtkhdf", "on 16 processes");
}

// The counterpart of check_closure in backward.cpp.
void check_closure(const Ranks& ranks, HexMesh mesh, const Vec3& gravity,
                   const MechanicsOptions& options, Run& run, Equilibrium& found) {
  if (ranks.root()) store(found, mesh);
  Equilibrium again;
  {
    Timer::Scope phase(found.timer, "closure");
    again = solve_forward_on(ranks, mesh, gravity, options, run.progress());
  }
  if (!ranks.root()) return;
  if (const auto closure = judge_closure(again, mesh, found))
    run.report().set("closure_mm", *closure);
}

void run_backward(const Choices& c, Run& run, const Ranks& ranks) {
  const Vec3 gravity = c.gravity.vector();
  std::optional<MechanicsRun> mechanics;
  ranks.together([&] {
    if (ranks.root()) mechanics.emplace(run, c.mechanics, "none", c.mesh, read_mesh(c.mesh));
  });
  const MechanicsOptions options =
      shared_options(ranks, mechanics ? mechanics->options() : MechanicsOptions{});
  const HexMesh none;
  const HexMesh& mesh = mechanics ? mechanics->mesh() : none;
  Equilibrium found = solve_backward_on(ranks, mesh, gravity, options, run.progress());
  if (found.converged()) check_closure(ranks, mesh, gravity, options, run, found);
  run.report().set("ranks", ranks.size());
  ranks.together([&] {
    if (!mechanics) return;
    write_report(found, mesh, options, run.report());
    mechanics->finish(found, c.reference);
  });
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("backward-mpi", "backward on several processes, for very large meshes");
  declare(tool, c);
  return ranks_main(tool, argc, argv,
                    [&c](Run& run, const Ranks& ranks) { run_backward(c, run, ranks); });
}
