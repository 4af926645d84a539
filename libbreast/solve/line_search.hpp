// SPDX-License-Identifier: GPL-3.0-or-later
// The line search along a Newton direction, one rule for all problems.
#pragma once

#include <optional>

#include "solve/newton.hpp"

namespace breast {

struct SearchResult {
  std::optional<Trial> trial;  ///< none: no length was acceptable
  double length = 0;
  bool any_admissible = false;  ///< at least one trial was admissible
};

/// Shortens the step until it is accepted, and doubles it where the body snaps through.
SearchResult line_search(NewtonSystem& system, const NewtonDirection& direction,
                         const LineSearchRule& rule);

}  // namespace breast
