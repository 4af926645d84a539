// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/agreement.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

constexpr double most_volume = 0.02, most_missed = 0.05, most_cut_off = 0.02;

std::string percent(double fraction) {
  return format_fixed(100 * fraction, 1) + " %";
}

}  // namespace

std::optional<std::string> mismatch(const BodyMeshReport& body, const TissueReport& tissue) {
  const double excess = body.body_volume / tissue.segmented_volume - 1;
  const double cut_off =
      std::max(0.0, (body.body_volume - body.mesh_volume) / tissue.segmented_volume);
  const double missed = tissue.missed_fraction - cut_off;
  if (std::abs(excess) <= most_volume && missed <= most_missed) return std::nullopt;
  return message("the geometry does not agree with the labels: it encloses ",
                 format_fixed(body.body_volume / mm3_per_ml, 0),
                 " ml, while the labelled breast has ",
                 format_fixed(tissue.segmented_volume / mm3_per_ml, 0), " ml (at most ",
                 percent(most_volume), " apart), and ", percent(missed),
                 " of that breast lies outside it (at most ", percent(most_missed), ")");
}

std::optional<std::string> too_coarse(const BodyMeshReport& body) {
  const double lost = 1 - body.mesh_volume / body.body_volume;
  if (std::abs(lost) <= most_cut_off) return std::nullopt;
  return message("the flat faces of this mesh lose ", percent(lost),
                 " of the body's volume (usually below ", percent(most_cut_off),
                 "): give more --elements");
}

}  // namespace breast
