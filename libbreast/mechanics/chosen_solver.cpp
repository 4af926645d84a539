// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/chosen_solver.hpp"

#include "core/error.hpp"
#include "solve/choose_solver.hpp"

namespace breast {

namespace {

// With plain invariants the laws resist changes of volume in addition to the pressure (law 9 with
// 176 times its shear modulus), which multigrid cycles cannot handle well: 630 iterations instead
// of 70 with isochoric invariants.
SolverChoice choice_for(double unknowns, const MechanicsOptions& options) {
  SolverChoice choice = choose_solver(unknowns);
  if (options.invariants == Invariants::plain && choice.direct_fits) {
    choice.first = LinearSolver::direct;
  }
  return choice;
}

}  // namespace

Equilibrium with_chosen_solver(double unknowns, const MechanicsOptions& options, Progress& progress,
                               const SolveAttempt& attempt) {
  MechanicsOptions chosen = options;
  if (options.solver != SolverOption::automatic) return attempt(chosen, false);
  const SolverChoice choice = choice_for(unknowns, options);
  chosen.solver =
      choice.first == LinearSolver::direct ? SolverOption::direct : SolverOption::multigrid;
  if (choice.first == LinearSolver::direct || !choice.direct_fits) return attempt(chosen, false);

  Timer timer;
  Equilibrium quick;
  {
    Timer::Scope phase(timer, "multigrid attempt");
    quick = attempt(chosen, true);
  }
  if (quick.converged()) return quick;
  progress.note(message("multigrid gave up (", quick.record.reason, "): solving directly"));
  chosen.solver = SolverOption::direct;
  Equilibrium sure = attempt(chosen, false);
  sure.timer.add("multigrid attempt", timer.seconds("multigrid attempt"));
  return sure;
}

}  // namespace breast
