// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/time_left.hpp"

#include <algorithm>
#include <cmath>

#include "core/table.hpp"

namespace breast {

namespace {
constexpr double least_time_s = 2, least_progress = 0.02, short_stage_s = 10;
constexpr std::size_t most_samples = 512;
}  // namespace

std::optional<double> TimeLeft::update(std::string_view stage, double fraction, double now) {
  if (!std::isfinite(fraction) || fraction < 0) {
    samples_.clear();
    stage_ = stage;
    return {};
  }
  fraction = std::min(fraction, 1.0);
  const bool goes_on = !samples_.empty() && fraction > samples_.back().fraction;
  if (samples_.empty() || (stage != stage_ && !goes_on)) {
    samples_.assign(1, {now, fraction});
    stage_ = stage;
    return {};
  }
  stage_ = stage;
  samples_.push_back({now, fraction});
  // The beginning and the end are kept; the reports between are thinned.
  if (samples_.size() > most_samples) {
    for (std::size_t i = 1; i + 1 < samples_.size(); ++i)
      samples_.erase(samples_.begin() + long(i));
  }
  const Sample begin = samples_.front();
  const double elapsed = now - begin.time;
  if (elapsed < least_time_s || fraction - begin.fraction < least_progress || fraction == 1)
    return {};
  const double middle = begin.time + 0.5 * elapsed;
  const auto later = std::find_if(samples_.rbegin(), samples_.rend(),
                                  [&](const Sample& s) { return s.time <= middle; });
  const double progress = fraction - later->fraction;
  const Sample from = progress > 0 ? *later : begin;
  const double left = (1 - fraction) * (now - from.time) / (fraction - from.fraction);
  if (elapsed + left < short_stage_s) return {};
  return left;
}

std::string time_left_text(double seconds) {
  if (seconds > 90) return "about " + format_fixed(std::ceil(seconds / 60), 0) + " min left";
  return "about " +
         format_fixed(seconds < 20 ? std::ceil(seconds) : 5 * std::ceil(seconds / 5), 0) +
         " s left";
}

}  // namespace breast
