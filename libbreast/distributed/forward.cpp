// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"
#include "distributed/collected.hpp"
#include "distributed/distributed.hpp"
#include "distributed/load_steps.hpp"
#include "distributed/part_equilibrium.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

constexpr int first_limit = 25, later_limit = 12;  // Newton iterations of a load step

class ForwardSteps final : public LoadSteps {
 public:
  ForwardSteps(const PartProblem& problem, Progress& progress)
      : LoadSteps(problem, "forward-mpi", part_equilibrium_tolerance, progress) {}

 private:
  NewtonResult attempt(State& state, double from, double to) override;
  void judge(const State& state, double reached, const NewtonResult& failure) override;
};

NewtonResult ForwardSteps::attempt(State& state, double from, double to) {
  const int limit = found.steps == 0 ? first_limit : later_limit;
  PartEquilibrium system(problem_, solver_, matrix_, state, limit, found.timer);
  const NewtonResult result = iterate(system, from, to);
  found.min_det_F = system.forces().min_det_F;
  return result;
}

// The last multigrid levels show stability, for a neighbouring state. The augmentation that suits
// them does not necessarily preserve volumes as well as incompressibility does.
void ForwardSteps::judge(const State& state, double reached, const NewtonResult& failure) {
  if (reached < 1) {
    found.reason_id = stop_name(failure.stop);
    found.load_reached = reached;
    found.record.reason = message("stopped at ", 100 * reached, " % of the load: ", failure.reason);
    return;
  }
  Timer::Scope phase(found.timer, "stability");
  found.stable = (solver_.factorisations() > 0 && solver_.positive_definite()) ||
                 definite(state, 0) || definite(state, nearly_incompressible);
  conclude_stability("the shape found is in balance but the breast would not stay in it");
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
  return solve_on_ranks(ranks, mesh, chosen, &HexMesh::reference, gravity, gravity,
                        [&](const PartProblem& problem) {
                          return std::make_unique<ForwardSteps>(problem, progress);
                        });
}

}  // namespace breast
