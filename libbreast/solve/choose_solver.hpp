// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the linear solver for a mesh by a cost model fitted to measurements (docs/methods.md,
// section 5).
#pragma once

#include "solve/saddle.hpp"

namespace breast {

/// Expected cost of a Newton step with either solver on this machine.
struct SolverCost {
  double factor_gb = 0, factor_seconds = 0;  ///< direct: memory of the factor and fronts, one step
  double cycle_seconds = 0;                  ///< multigrid
};
/// For a mesh of `unknowns` displacements, on `threads` threads.
SolverCost predict_cost(double unknowns, int threads);

struct SolverChoice {
  LinearSolver first = LinearSolver::direct;  ///< the cheaper one
  bool direct_fits = true;                    ///< in half the memory that is available
};
/// The direct solver if it fits and is expected to be faster, otherwise multigrid.
SolverChoice choose_solver(double unknowns);

}  // namespace breast
