// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/distributed.hpp"

#include <functional>
#include <optional>

#include "core/error.hpp"
#include "distributed/bytes.hpp"
#include "distributed/part_saddle.hpp"
#include "mechanics/backward_steps.hpp"
#include "mechanics/forward_steps.hpp"
#include "mechanics/solution.hpp"
#include "mesh/nodal.hpp"

namespace breast {

namespace {

/// `options` with the only linear solver that works on several ranks.
MechanicsOptions options_for_ranks(const MechanicsOptions& options) {
  if (options.solver == SolverOption::direct) {
    throw input_error(
        "--solver direct: over several processes the solver is multigrid; leave the option out, or "
        "use forward and backward");
  }
  MechanicsOptions chosen = options;
  chosen.solver = SolverOption::multigrid;
  return chosen;
}

void note_solver(const PartSaddle& solver, SolveSummary& summary) {
  summary.linear_solver = "PETSc, GMRES split by field, GAMG";
  summary.matrix_values = solver.matrix_values();
  summary.factor_values = solver.level_values();
  summary.factorisations = solver.factorisations();
}

/// What a rank sends of its state: the values of its owned nodes and its elements.
struct OwnValues {
  std::vector<int> nodes, elements;
  std::vector<double> reference, x, p;
};

template <class Bytes>
void pass(Bytes& bytes, OwnValues& own) {
  bytes(own.nodes);
  bytes(own.elements);
  bytes(own.reference);
  bytes(own.x);
  bytes(own.p);
}

std::vector<char> packed(const MeshPart& part, const State& state) {
  const long count = 3L * part.owned;
  OwnValues own{{part.nodes.begin(), part.nodes.begin() + part.owned},
                part.elements,
                {state.reference.begin(), state.reference.begin() + count},
                {state.x.begin(), state.x.begin() + count},
                {state.p.begin(), state.p.end()}};
  ByteWriter out;
  pass(out, own);
  return out.take();
}

void place(const std::vector<double>& values, const std::vector<int>& at, long each,
           Eigen::VectorXd& whole) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (long k = 0; k < each; ++k)
      whole[at[i] * each + k] = values[i * std::size_t(each) + std::size_t(k)];
  }
}

void add(const std::vector<char>& bytes, int pressures_each, State& whole) {
  ByteReader in(bytes);
  OwnValues own;
  pass(in, own);
  place(own.reference, own.nodes, 3, whole.reference);
  place(own.x, own.nodes, 3, whole.x);
  place(own.p, own.elements, pressures_each, whole.p);
}

/// The state of the whole body on the root, from all ranks; empty elsewhere.
State collected(const Exchange& exchange, const HexMesh& mesh, int pressures_each,
                const State& own) {
  const Ranks& ranks = exchange.ranks();
  const std::vector<char> bytes = packed(exchange.part(), own);
  State whole;
  if (!ranks.root()) {
    ranks.send(bytes, 0);
    return whole;
  }
  whole.reference = whole.x = Eigen::VectorXd::Zero(3L * mesh.nodes());
  whole.p = Eigen::VectorXd::Zero(long(pressures_each) * mesh.elements());
  add(bytes, pressures_each, whole);
  for (int rank = 1; rank < ranks.size(); ++rank) add(ranks.receive(rank), pressures_each, whole);
  return whole;
}

/// Follows `load` (nodal forces of this part, µN) from `state`.
using Follow = std::function<void(LoadedProblem& loaded, PartSaddle& solver,
                                  const Eigen::VectorXd& load, State& state, Equilibrium& found)>;

/// Shares `mesh` among the ranks, follows the load of `gravity` (mm/s²) from the shape `start`
/// (&HexMesh::imaged or &HexMesh::reference), and collects the result on the root. `gravity_found`
/// (mm/s²) acts on the shape found. Collective.
Equilibrium solve_on_ranks(const Ranks& ranks, const HexMesh& mesh, const MechanicsOptions& options,
                           std::vector<Vec3> HexMesh::*start, const Vec3& gravity,
                           const Vec3& gravity_found, const Follow& follow) {
  Equilibrium found;
  MeshPart part;
  {
    Timer::Scope phase(found.timer, "partition");
    part = share_mesh(ranks, mesh, options);
  }
  const auto exchange = std::make_shared<Exchange>(ranks, part);
  std::optional<Scene> scene;
  ranks.together([&] {
    MechanicsOptions own = options;
    own.wall_surface = part.wall;
    scene.emplace(part.mesh, own, PartOfBody{part.held, part.sliding, exchange});
  });
  State state = scene->at_rest(flatten(part.mesh.*start));
  {
    const Eigen::VectorXd load = scene->gravity_force(gravity);
    LoadedProblem loaded = scene->problem(load);
    PartSaddle solver(*exchange, loaded.problem.space());
    follow(loaded, solver, load, state, found);
    note_solver(solver, found);
  }
  const int pressures_each = scene->solid().space()->pressures->rows;
  const State whole = collected(*exchange, mesh, pressures_each, state);
  ranks.together([&] {
    if (ranks.root())
      conclude(found, Scene(mesh, options, TangentStorage::packed), whole, gravity_found);
  });
  return found;
}

}  // namespace

Equilibrium solve_forward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                             const MechanicsOptions& options, Progress& progress) {
  MechanicsOptions chosen;
  ranks.together([&] {
    chosen = options_for_ranks(options);
    if (ranks.root() && mesh.reference.size() != mesh.points.size()) {
      throw input_error("mesh: no stress-free reference shape; run backward first");
    }
  });
  const Follow follow = [&](LoadedProblem& loaded, PartSaddle& solver, const Eigen::VectorXd& load,
                            State& state, Equilibrium& found) {
    SaddleMatrix matrix = loaded.problem.make_matrix();
    ForwardSteps(loaded, solver, matrix, false, "forward-mpi", found, progress).run(load, state);
  };
  return solve_on_ranks(ranks, mesh, chosen, &HexMesh::reference, gravity, gravity, follow);
}

Equilibrium solve_backward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                              const MechanicsOptions& options, Progress& progress) {
  MechanicsOptions chosen;
  ranks.together([&] { chosen = options_for_ranks(options); });
  const Follow follow = [&](LoadedProblem& loaded, PartSaddle& solver, const Eigen::VectorXd& load,
                            State& state, Equilibrium& found) {
    BackwardSteps(loaded, solver, solver.solve_reference(), false, "backward-mpi", found, progress)
        .run(load, state);
  };
  Equilibrium found =
      solve_on_ranks(ranks, mesh, chosen, &HexMesh::imaged, gravity, Vec3::Zero(), follow);
  found.points = found.reference;
  return found;
}

}  // namespace breast
