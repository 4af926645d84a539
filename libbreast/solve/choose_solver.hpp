// Which linear solver a mesh can afford: a cost model fitted to measurements (docs/methods.md,
// section 5).
#pragma once

#include "solve/saddle.hpp"

namespace breast {

/// What a Newton step with either solver is expected to take on this machine.
struct SolverCost {
  double factor_gb = 0, factor_seconds = 0;  ///< direct: memory of the factor and fronts, one step
  double cycle_gb = 0, cycle_seconds = 0;    ///< multigrid
};
/// For a mesh of `unknowns` displacements, on `threads` threads.
SolverCost predict_cost(double unknowns, int threads);

/// The direct solver, which knows every instability, where its memory fits in half of what is
/// available and it takes less than four times the time of multigrid.
LinearSolver choose_solver(double unknowns);

}  // namespace breast
