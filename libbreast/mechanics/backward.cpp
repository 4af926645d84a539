// SPDX-License-Identifier: GPL-3.0-or-later
// The inverse problem: X such that the imaged shape x is in equilibrium. The residual is that of
// forward, R(X, x, p) = 0 with x given, so that forward returns the imaged shape to rounding error.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/inverse_system.hpp"
#include "mechanics/load_steps.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/solution.hpp"
#include "mechanics/stability/explain.hpp"

namespace breast {

namespace {

class BackwardSolve {
 public:
  BackwardSolve(const HexMesh& mesh, const MechanicsOptions& options, bool fail_fast,
                Progress& progress)
      : scene_(mesh, options),
        fail_fast_(fail_fast),
        progress_(progress),
        imaged_(flatten(mesh.imaged)),
        loaded_(scene_.problem(Eigen::VectorXd::Zero(3L * mesh.nodes()))),
        inverse_(loaded_.problem, scene_.solid().solver(), fail_fast, found_.timer) {}

  /// Nodal forces (µN); `start` is the initial guess and gives the positions of held nodes.
  Equilibrium run(const Eigen::VectorXd& load, const Eigen::VectorXd& start);
  Equilibrium run(const Vec3& gravity);
  /// Whether a body that is stable in the imaged shape is found in one step.
  bool stands(const Vec3& gravity) { return stands_under(scene_.gravity_force(gravity)); }

 private:
  State guess(const Eigen::VectorXd& reference) const {
    return {reference, imaged_, scene_.solid().rest_pressure()};
  }
  /// A solve that increases the load from the fraction `from` to the fraction `to`.
  NewtonResult solve(State& state, double from = 0, double to = 1);
  LoadReached follow(const Eigen::VectorXd& load, State& state);
  bool stays(const State& state);
  bool stands_under(const Eigen::VectorXd& load);
  void judge_end(const State& state, const LoadReached& reached);
  double stable_part(const Eigen::VectorXd& load, double reached, bool stable);
  void find_needed_stiffness(const Eigen::VectorXd& load);
  Equilibrium finish(const State& state);

  Equilibrium found_;
  Scene scene_;
  bool fail_fast_;
  Progress& progress_;
  Eigen::VectorXd imaged_;
  LoadedProblem loaded_;
  InverseSolver inverse_;
  SolveLog log_{found_, progress_};
};

NewtonResult BackwardSolve::solve(State& state, double from, double to) {
  NewtonResult result =
      inverse_.solve(state, log_.begin_step("backward", from, to, inverse_tolerance));
  found_.residual = result.residual;
  found_.min_det_F = inverse_.min_det_F();
  return result;
}

LoadReached BackwardSolve::follow(const Eigen::VectorXd& load, State& state) {
  LoadSteps steps;
  steps.divide = !fail_fast_;
  steps.set_load = [&](double part) { loaded_.set_load(part * load); };
  steps.solve = [&](State& trial, double from, double to) { return solve(trial, from, to); };
  return follow_load(steps, state);
}

// Whether the imaged shape is a stable equilibrium of the unloaded shape found; not if that shape
// is folded. The augmentation that suits multigrid does not necessarily preserve volumes as well as
// incompressibility does.
bool BackwardSolve::stays(const State& state) {
  Timer::Scope phase(found_.timer, "stability");
  if (inverse_.stable(state, 0)) return true;
  return !fail_fast_ && scene_.solid().solver() == LinearSolver::multigrid &&
         inverse_.stable(state, nearly_incompressible);
}

bool BackwardSolve::stands_under(const Eigen::VectorXd& load) {
  loaded_.set_load(load);
  State trial = guess(imaged_);
  return solve(trial).converged && stays(trial);
}

// Newton's direction always reduces the residual unless ∂R/∂X is singular: if the solution path
// stops because no step or no direction is found, it ends there. If no load was reached at all, the
// steps may have been too long.
void BackwardSolve::judge_end(const State& state, const LoadReached& reached) {
  const double part = found_.load_reached = reached.part;
  found_.stable = part > 0 ? stays(state) : true;
  SolveRecord& record = found_.record;
  if (!reached.whole()) {
    const NewtonResult& failure = reached.last;
    const bool ends =
        part > 0 && (failure.stop == NewtonStop::singular_inverse ||
                     failure.stop == NewtonStop::no_step || failure.stop == NewtonStop::folded);
    found_.reason_id = ends ? "no_stress_free_body" : stop_name(failure.stop);
    record.reason = message("stopped at ", 100 * part, " % of the load: ", failure.reason);
    if (ends) {
      record.reason = message(
          "no stress-free body: the family of stress-free shapes that gravity deforms into the "
          "imaged one ends near ",
          100 * part, " % of the load (", failure.reason, ")");
    }
  } else if (!found_.stable) {
    record.status = SolveStatus::unstable;
    found_.reason_id = unstable_equilibrium;
    record.reason =
        "unstable equilibrium: the imaged shape is an equilibrium of the body found, but not a "
        "stable one";
  } else {
    record.status = SolveStatus::converged;
  }
  if (!found_.stable && !fail_fast_) note_instability(inverse_.instability(state), found_);
}

// Stiffnesses times s under the full load are the same problem as the part 1/s of the load. Finds
// the largest part, within 10 %, for which the body exists and is stable in the imaged shape.
double BackwardSolve::stable_part(const Eigen::VectorXd& load, double reached, bool stable) {
  if (stable) return reached;
  double low = 0, high = reached;
  for (int i = 0; i < 7 && high > 1.1 * low; ++i) {
    const double part = low > 0 ? std::sqrt(low * high) : 0.4 * high;
    (stands_under(part * load) ? low : high) = part;
  }
  return low;
}

void BackwardSolve::find_needed_stiffness(const Eigen::VectorXd& load) {
  SolveSummary summary = found_;  // summary of the state itself; the search only adds to the time
  const double part = stable_part(load, summary.load_reached, summary.stable);
  summary.timer = found_.timer;
  static_cast<SolveSummary&>(found_) = std::move(summary);
  if (!(part > 0)) return;
  found_.stiffness_factor_needed = 1 / part;
  found_.record.reason +=
      message("; stiffnesses and supports that are all ", std::ceil(100 / part) / 100,
              " times larger would give a stable body");
}

Equilibrium BackwardSolve::finish(const State& state) {
  note_solver(inverse_.solver(), inverse_.matrix(), found_);
  found_.factorisations = inverse_.solver().factorisations();
  conclude(found_, scene_, state, Vec3::Zero());
  found_.points = found_.reference;
  return found_;
}

Equilibrium BackwardSolve::run(const Eigen::VectorXd& load, const Eigen::VectorXd& start) {
  State state = guess(start);
  judge_end(state, follow(load, state));
  return fail_fast_ && !found_.converged() ? found_ : finish(state);
}

Equilibrium BackwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  State state = guess(imaged_);
  judge_end(state, follow(load, state));
  if (fail_fast_ && !found_.converged()) return found_;
  if (!found_.converged()) {
    find_needed_stiffness(load);
    find_remedy(
        scene_.mesh(), scene_.options(),
        [&](const MechanicsOptions& changed) {
          return BackwardSolve(scene_.mesh(), changed, false, no_progress()).stands(gravity);
        },
        progress_, found_);
  }
  return finish(state);
}

}  // namespace

Equilibrium solve_backward(const HexMesh& mesh, const Vec3& gravity,
                           const MechanicsOptions& options, Progress& progress) {
  return with_chosen_solver(3.0 * mesh.nodes(), options, progress,
                            [&](const MechanicsOptions& chosen, bool fail_fast) {
                              return BackwardSolve(mesh, chosen, fail_fast, progress).run(gravity);
                            });
}

Equilibrium solve_backward_under(const HexMesh& mesh, const Eigen::VectorXd& forces,
                                 const MechanicsOptions& options, Progress& progress) {
  if (mesh.reference.size() != mesh.imaged.size() || forces.size() != 3L * mesh.nodes()) {
    throw input_error(
        "backward under given forces needs a first guess of the reference shape and 3 ",
        "numbers per node: ", mesh.reference.size(), " and ", forces.size(), " for ", mesh.nodes(),
        " nodes");
  }
  const Eigen::VectorXd start = flatten(mesh.reference);
  return with_chosen_solver(
      3.0 * mesh.nodes(), options, progress, [&](const MechanicsOptions& chosen, bool fail_fast) {
        return BackwardSolve(mesh, chosen, fail_fast, progress).run(forces, start);
      });
}

}  // namespace breast
