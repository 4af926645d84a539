// SPDX-License-Identifier: GPL-3.0-or-later
// Estimate of the remaining time of a stage from the fractions it has reported.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace breast {

/// Uses the rate of the second half of the time since the stage began, so that changes of the rate
/// are followed.
class TimeLeft {
 public:
  /// Remaining seconds of `stage`, of which `fraction` is done at the time `now` (seconds of any
  /// monotonic clock). No value if too little is known (less than 2 s or 2 % of progress), for a
  /// fraction that is below 0, 1 or not finite, and for a stage that takes less than 10 s in total.
  /// Another stage starts a new estimate, unless its fraction continues from the end of the last
  /// one; both are then treated as one stage.
  std::optional<double> update(std::string_view stage, double fraction, double now);

 private:
  struct Sample {
    double time, fraction;
  };
  std::string stage_;
  std::deque<Sample> samples_;  ///< the first is the beginning
};

/// "about 40 s left", "about 3 min left".
std::string time_left_text(double seconds);

}  // namespace breast
