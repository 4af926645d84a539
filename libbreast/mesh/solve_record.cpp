// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/solve_record.hpp"

namespace breast {

const char* status_name(SolveStatus status) {
  switch (status) {
    case SolveStatus::converged:
      return "converged";
    case SolveStatus::stopped_early:
      return "stopped_early";
    case SolveStatus::not_gripped:
      return "not_gripped";
    case SolveStatus::unstable:
      return "unstable";
    case SolveStatus::not_converged:
      return "not_converged";
  }
  return "";
}

std::optional<SolveStatus> status_from_name(const std::string& name) {
  for (const SolveStatus status :
       {SolveStatus::converged, SolveStatus::stopped_early, SolveStatus::not_gripped,
        SolveStatus::unstable, SolveStatus::not_converged}) {
    if (name == status_name(status)) return status;
  }
  return {};
}

}  // namespace breast
