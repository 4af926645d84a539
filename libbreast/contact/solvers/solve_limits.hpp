// SPDX-License-Identifier: GPL-3.0-or-later
// When the solve at one plate position goes on and when it is abandoned: what the contact methods
// share.
#pragma once

#include "solve/newton.hpp"

namespace breast {

/// The friction bounds follow the normal forces once the imbalance is this fraction of their lag.
inline constexpr double balance_to_follow = 0.1;
/// Additional iterations for each one with an indefinite tangent: itself, and one to settle.
inline constexpr int slip_allowance = 2;

/// A solve that may fail fast is abandoned if the first step has to be shorter than `first_step`,
/// or if after `iterations` the imbalance is still more than `remainder` of the first.
struct BadBeginning {
  double first_step = 0, remainder = 0;
  int iterations = 0;

  /// True of a solve whose imbalance is `now` and was `first` after one iteration.
  bool seen_in(const NewtonResult& so_far, double now, double first) const {
    const int made = int(so_far.iterations.size());
    if (made == 1) return so_far.iterations.back().step_length < first_step;
    return made == iterations && now > remainder * first;
  }
};

}  // namespace breast
