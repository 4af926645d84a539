// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/closure.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace breast {

std::optional<double> judge_closure(const Equilibrium& again, const HexMesh& mesh,
                                    Equilibrium& backward) {
  std::optional<double> closure;
  if (again.converged()) {
    closure = 0;
    for (int i = 0; i < mesh.nodes(); ++i)
      closure = std::max(*closure, (again.points[i] - mesh.imaged[i]).norm());
    if (*closure <= closure_bound_mm) return closure;
  }
  const std::string ends =
      closure ? message("ends ", *closure, " mm from the imaged shape, where at most ",
                        closure_bound_mm, " mm is rounding")
              : "does not reach the imaged shape (" + again.record.reason + ")";
  backward.record.status = SolveStatus::not_converged;
  backward.reason_id = "not_closed";
  backward.record.reason =
      "forward from the stress-free shape found " + ends +
      ": the same gravity has another equilibrium, so that predictions from this body are arbitrary; "
      "stiffen a tissue or a support by more than the least change that gives a solution (--scale "
      "fat=150, --wall or --cut)";
  return closure;
}

}  // namespace breast
