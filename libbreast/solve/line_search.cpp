// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/line_search.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

namespace {

/// Largest fraction of the initial slope that may remain at the end of a step.
constexpr double slope_kept = 0.8;
/// The same where the step has gone past the minimum of an energy with kinks: full steps from one
/// side of a kink to the other could otherwise repeat for ever.
constexpr double slope_kept_past_kink = 0.3;
/// Longest multiple of a shifted step.
constexpr double longest_slip = 64;
/// Number of further times that the slope determines the shortening of a step, and the smallest
/// factor that it may give.
constexpr int most_by_slope = 3;
constexpr double least_factor = 0.01;
/// Number of lengths tried between one before a kink and one beyond it.
constexpr int most_between = 5;
/// Largest fraction of the initial slope where the minimum along a direction is sought, and the number
/// of lengths tried for it.
constexpr double slope_kept_at_minimum = 0.1;
constexpr int most_for_minimum = 12;

/// Along a direction of negative curvature a shifted step is far too short: it is doubled while the
/// slope remains as steep as expected.
double go_further(NewtonSystem& system, const NewtonDirection& direction, Trial& trial) {
  double length = 1;
  while (trial.seen.along < -slope_kept * direction.slope && length < longest_slip) {
    std::optional<Trial> further = system.attempt(2 * length);
    if (!further || further->seen.along > slope_kept * direction.slope) break;
    length *= 2;
    trial = std::move(*further);
  }
  return length;
}

bool accepted(const Appraisal& seen, const NewtonDirection& direction, const LineSearchRule& rule) {
  if (rule.any || seen.merit < rule.merit || seen.residual < rule.tolerance) return true;
  // In a step with an indefinite tangent (a node slips over the edge of a plate) the imbalance may
  // have to grow: a decrease of the energy is then sufficient.
  if (rule.downhill_suffices) return seen.along <= slope_kept * direction.slope;
  const double slope = std::abs(direction.slope);
  return rule.flat_suffices && seen.along >= -slope_kept * slope &&
         seen.along <= (rule.kinks ? slope_kept_past_kink : slope_kept) * slope;
}

/// The factor on a length at which the slope would be zero if it were linear from
/// the start to the trial's.
double flat_factor(const Appraisal& seen, const NewtonDirection& direction) {
  const double slope = std::abs(direction.slope);
  if (!(seen.along > 0)) return 0.5;
  return std::clamp(slope / (slope + seen.along), least_factor, 0.5);
}

/// Where a penalty becomes active only after part of the way, the slope suggests a length far before
/// that place, and steps of this length would creep towards it. Goes on from the accepted length to
/// where the energy is flat, while it falls as steeply as at the start, and stays in front of `beyond`,
/// a length past the minimum.
void approach_kink(NewtonSystem& system, const NewtonDirection& direction,
                   const LineSearchRule& rule, double beyond, SearchResult& result) {
  for (int k = 0; k < most_between; ++k) {
    if (result.trial->seen.along >= -slope_kept * std::abs(direction.slope)) return;
    const double length = std::sqrt(result.length * beyond);
    std::optional<Trial> trial = system.attempt(length);
    if (trial && accepted(trial->seen, direction, rule)) {
      result.length = length;
      result.trial = std::move(trial);
    } else {
      beyond = length;
    }
  }
}

/// The length at which the energy along the direction is smallest, by the secant through its slopes on
/// both sides of it, where the slope of an end that stays is halved (Illinois method). A full step at
/// whose end the energy still falls is taken.
SearchResult search_minimum(NewtonSystem& system, const NewtonDirection& direction,
                            const LineSearchRule& rule) {
  SearchResult result;
  const double slope = std::abs(direction.slope);
  double low = 0, high = 1, before = -slope, past = 0, length = 1;
  for (int k = 0; k < most_for_minimum; ++k) {
    std::optional<Trial> trial = system.attempt(length);
    if (trial) {
      result.any_admissible = true;
      const double along = trial->seen.along;
      const bool done = std::abs(along) <= slope_kept_at_minimum * slope ||
                        trial->seen.residual < rule.tolerance || (along <= 0 && length == 1);
      if (along <= 0 || done) {
        result.trial = std::move(trial);
        result.length = length;
      }
      if (done) return result;
      if (along <= 0) {
        low = length, before = along, past *= 0.5;
      } else {
        before *= past > 0 ? 0.5 : 1;
        high = length, past = along;
      }
    } else {
      high = length, past = 0;
    }
    length = past > 0 ? low + (high - low) * before / (before - past) : 0.5 * (low + high);
  }
  return result;
}

}  // namespace

SearchResult line_search(NewtonSystem& system, const NewtonDirection& direction,
                         const LineSearchRule& rule) {
  if (rule.to_minimum) {
    SearchResult lowest = search_minimum(system, direction, rule);
    if (lowest.trial) return lowest;
  }
  SearchResult result;
  // Where the tangent is indefinite the slope is anything but linear.
  const bool by_slope = rule.kinks && !rule.downhill_suffices;
  const int most = rule.most_halvings + (by_slope ? most_by_slope : 0);
  double length = 1, factor = 0.5, beyond = 1;
  for (int i = 0; i <= most; ++i, length *= factor) {
    factor = 0.5;
    std::optional<Trial> trial = system.attempt(length);
    if (!trial) continue;
    result.any_admissible = true;
    if (i >= rule.most_halvings) factor = flat_factor(trial->seen, direction);
    if (!accepted(trial->seen, direction, rule)) {
      beyond = length;
      continue;
    }
    if (rule.downhill_suffices && length == 1) length = go_further(system, direction, *trial);
    result.trial = std::move(trial);
    result.length = length;
    if (i > rule.most_halvings) approach_kink(system, direction, rule, beyond, result);
    return result;
  }
  return result;
}

}  // namespace breast
