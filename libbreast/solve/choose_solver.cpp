// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/choose_solver.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "core/parallel.hpp"

namespace breast {

namespace {

// Memory that this machine could still provide, GB; unlimited if the machine does not say.
double available_gb() {
  std::ifstream info("/proc/meminfo");
  std::string key, unit;
  double kb = 0;
  while (info >> key >> kb) {
    std::getline(info, unit);
    if (key == "MemAvailable:") return kb * 1e-6;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

SolverCost predict_cost(double unknowns, int threads) {
  const double size = unknowns / 15000;  // of the 16³ mesh
  SolverCost cost;
  cost.factor_gb = 0.1 * std::pow(size, 1.45);
  cost.factor_seconds = 0.37 * std::pow(size, 1.67) / threads;
  cost.cycle_seconds = 0.23 * std::pow(size, 1.25) / threads;
  return cost;
}

SolverChoice choose_solver(double unknowns) {
  const SolverCost cost = predict_cost(unknowns, threads());
  const bool fits = cost.factor_gb < 0.5 * available_gb();
  const bool direct = fits && cost.factor_seconds <= cost.cycle_seconds;
  return {direct ? LinearSolver::direct : LinearSolver::multigrid, fits};
}

}  // namespace breast
