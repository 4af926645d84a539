// SPDX-License-Identifier: GPL-3.0-or-later
// How the solution of a shape ended, and its iterations.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace breast {

/// One row of the iterations table.
struct IterationRecord {
  int step = 0, iteration = 0;
  double residual = 0, min_det_F = 0, max_det_F = 0, step_length = 0, seconds = 0;
};
enum class SolveStatus {
  converged,
  stopped_early,  ///< compress: a valid equilibrium before the target
  not_gripped,    ///< compress: the target, but the plates hardly touch the breast
  unstable,       ///< backward: an equilibrium, but an unstable one
  not_converged,
};
/// Name of a status in files and reports, and its inverse, which has no value for any other text.
const char* status_name(SolveStatus status);
std::optional<SolveStatus> status_from_name(const std::string& name);
struct SolveRecord {
  SolveStatus status = SolveStatus::not_converged;
  std::string reason;  ///< empty when converged
  std::vector<IterationRecord> iterations;
};

}  // namespace breast
