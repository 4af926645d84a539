// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "distributed/collected.hpp"
#include "distributed/distributed.hpp"
#include "distributed/load_steps.hpp"
#include "distributed/part_inverse.hpp"
#include "mechanics/inverse_system.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

class BackwardSteps final : public LoadSteps {
 public:
  BackwardSteps(const PartProblem& problem, Progress& progress)
      : LoadSteps(problem, "backward-mpi", inverse_tolerance, progress) {}

 private:
  NewtonResult attempt(State& state, double from, double to) override;
  void judge(const State& state, double reached, const NewtonResult& failure) override;
};

NewtonResult BackwardSteps::attempt(State& state, double from, double to) {
  PartInverse system(problem_, solver_, matrix_, state, found.timer);
  const NewtonResult result = iterate(system, from, to);
  found.min_det_F = system.forces().min_det_F;
  return result;
}

// Stability is that of the imaged shape as an equilibrium of the unloaded shape found.
void BackwardSteps::judge(const State& state, double reached, const NewtonResult& failure) {
  found.load_reached = reached;
  if (reached < 1) {
    const bool ends =
        reached > 0 && (failure.stop == NewtonStop::singular_inverse ||
                        failure.stop == NewtonStop::no_step || failure.stop == NewtonStop::folded);
    found.reason_id = ends ? "no_stress_free_body" : stop_name(failure.stop);
    found.record.reason = message("stopped at ", 100 * reached, " % of the load: ", failure.reason);
    return;
  }
  Timer::Scope phase(found.timer, "stability");
  found.stable = definite(state, 0) || definite(state, nearly_incompressible);
  conclude_stability("the body found is in balance in the imaged shape but would not stay in it");
}

}  // namespace

Equilibrium solve_backward_on(const Ranks& ranks, const HexMesh& mesh, const Vec3& gravity,
                              const MechanicsOptions& options, Progress& progress) {
  MechanicsOptions chosen;
  ranks.together([&] { chosen = options_for_ranks(options); });
  Equilibrium found = solve_on_ranks(ranks, mesh, chosen, &HexMesh::imaged, gravity, Vec3::Zero(),
                                     [&](const PartProblem& problem) {
                                       return std::make_unique<BackwardSteps>(problem, progress);
                                     });
  found.points = found.reference;
  return found;
}

}  // namespace breast
