// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/collected.hpp"

#include "core/error.hpp"
#include "distributed/bytes.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

std::vector<double> plain_vector(const Eigen::VectorXd& v) {
  return {v.data(), v.data() + v.size()};
}

// The data of a rank that are collected: those of its owned nodes and its elements.
std::vector<char> packed(const MeshPart& part, const State& own) {
  ByteWriter out;
  out.put(std::vector<int>(part.nodes.begin(), part.nodes.begin() + part.owned));
  out.put(part.elements);
  out.put(plain_vector(own.reference.head(3L * part.owned)));
  out.put(plain_vector(own.x.head(3L * part.owned)));
  out.put(plain_vector(own.p));
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
  std::vector<int> nodes, elements;
  std::vector<double> reference, x, p;
  in.get(nodes);
  in.get(elements);
  in.get(reference);
  in.get(x);
  in.get(p);
  place(reference, nodes, 3, whole.reference);
  place(x, nodes, 3, whole.x);
  place(p, elements, pressures_each, whole.p);
}

}  // namespace

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

void conclude_on(const PartProblem& problem, const HexMesh& mesh, const MechanicsOptions& options,
                 const State& own, const Vec3& gravity, Equilibrium& found) {
  const Ranks& ranks = problem.ranks();
  const std::vector<char> bytes = packed(problem.part(), own);
  if (!ranks.root()) {
    ranks.send(bytes, 0);
    ranks.together([] {});
    return;
  }
  const int each = problem.pressures().rows;
  State whole;
  whole.reference = whole.x = Eigen::VectorXd::Zero(3L * mesh.nodes());
  whole.p = Eigen::VectorXd::Zero(long(each) * mesh.elements());
  add(bytes, each, whole);
  for (int rank = 1; rank < ranks.size(); ++rank) add(ranks.receive(rank), each, whole);
  ranks.together([&] {
    const Scene scene(mesh, options, TangentStorage::packed);
    conclude(found, scene, whole, gravity);
  });
}

}  // namespace breast
