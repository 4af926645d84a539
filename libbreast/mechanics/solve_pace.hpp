// SPDX-License-Identifier: GPL-3.0-or-later
// Completed fraction of a Newton solve, estimated from its residuals, for progress bars only.
#pragma once

#include <algorithm>
#include <cmath>

#include "solve/newton.hpp"

namespace breast {

/// Fraction of the decades from the first residual to `tolerance` that are completed; it never
/// decreases.
class SolvePace {
 public:
  explicit SolvePace(double tolerance) : tolerance_(tolerance) {}
  double after(const NewtonIteration& iteration) {
    first_ = std::max(first_, iteration.residual_before);
    const double decades = std::log(first_ / tolerance_);
    if (decades > 0 && iteration.residual > 0)
      done_ = std::clamp(std::log(first_ / iteration.residual) / decades, done_, 1.0);
    return done_;
  }

 private:
  double tolerance_, first_ = 0, done_ = 0;
};

}  // namespace breast
