// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/newton.hpp"

#include "core/error.hpp"
#include "solve/line_search.hpp"

namespace breast {

namespace {

NewtonIteration record_of(const Balance& before, const NewtonDirection& direction,
                          const SearchResult& found) {
  NewtonIteration record;
  record.residual_before = record.residual = before.residual;
  record.shift = direction.shift;
  record.linear_iterations = direction.linear_iterations;
  if (!found.trial) return record;
  record.step_length = found.length;
  record.residual = found.trial->seen.residual;
  record.min_det_F = found.trial->forces.min_det_F;
  record.max_det_F = found.trial->forces.max_det_F;
  return record;
}

}  // namespace

NewtonResult newton(NewtonSystem& system,
                    const std::function<void(const NewtonIteration&)>& watch) {
  NewtonResult result;
  const auto give_up = [&](NewtonStop stop, const std::string& reason) {
    result.stop = stop;
    result.reason = reason;
  };
  const auto settle = [&] {
    const int folded = system.folded_element();
    result.converged = folded < 0;
    if (folded < 0) return;
    give_up(NewtonStop::folded, message("element ", folded,
                                        " of the state found is turned inside out at a node or a "
                                        "quadrature point"));
  };
  while (true) {
    const Balance now = system.assess(result);
    result.residual = now.residual;
    if (now.converged) settle();
    if (now.stop != NewtonStop::none) give_up(now.stop, now.reason);
    if (now.converged || now.stop != NewtonStop::none) break;
    const NewtonDirection direction = system.direction(now);
    if (direction.shift > 0) ++result.indefinite;
    if (direction.stop != NewtonStop::none) {
      give_up(direction.stop, direction.reason);
      break;
    }
    SearchResult found = line_search(system, direction, system.rule(result, now, direction));
    const NewtonIteration record = record_of(now, direction, found);
    result.iterations.push_back(record);
    if (watch) watch(record);
    if (found.trial) {
      result.residual = record.residual;
      system.accept(std::move(*found.trial));
    } else if (!direction.provisional) {
      if (now.nearly) {
        settle();
      } else {
        const NewtonStop why = found.any_admissible ? NewtonStop::no_step : system.refusal();
        give_up(why, message("no acceptable step along the Newton direction: residual ",
                             now.residual, found.any_admissible ? "" : ", for every trial ",
                             found.any_admissible ? "" : describe(why)));
      }
      break;
    }
  }
  return result;
}

const char* stop_name(NewtonStop stop) {
  switch (stop) {
    case NewtonStop::none:
      return "";
    case NewtonStop::folded:
      return "folded_element";
    case NewtonStop::iteration_limit:
      return "iteration_limit";
    case NewtonStop::indefinite:
      return "indefinite_tangent";
    case NewtonStop::no_step:
      return "no_admissible_step";
    case NewtonStop::left_surface:
      return "left_wall_surface";
    case NewtonStop::linear_solver:
      return "linear_solver";
    case NewtonStop::singular_inverse:
      return "singular_inverse";
  }
  return "";
}

const char* describe(NewtonStop stop) {
  switch (stop) {
    case NewtonStop::none:
      return "converged";
    case NewtonStop::folded:
      return "an element folds";
    case NewtonStop::iteration_limit:
      return "no convergence within the iteration limit";
    case NewtonStop::indefinite:
      return "the tangent matrix cannot be factorised";
    case NewtonStop::no_step:
      return "no step reduces the residual";
    case NewtonStop::left_surface:
      return "a node slides beyond the end of the wall surface";
    case NewtonStop::linear_solver:
      return "a linear system is not solved";
    case NewtonStop::singular_inverse:
      return "the inverse problem is singular";
  }
  return "";
}

}  // namespace breast
