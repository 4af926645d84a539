// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of material sets by their errors at landmarks in the second posture.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "identification/identify.hpp"

namespace breast {

/// A set to be compared with the one found, with its own law, skin and supports.
struct ComparedSet {
  std::string name;
  MechanicsOptions mechanics;
};

/// The motion of a landmark, and the error of its position predicted with each set, mm.
struct ComparedLandmark {
  std::string name;
  /// Whether it was fitted; the error of the set found is then the one without this landmark.
  bool fitted = false;
  double moved = 0, found = 0;
  std::vector<double> sets;  ///< in the order of the sets; not a number if a set has no stable body
};

struct Comparison {
  std::vector<std::string> sets;
  /// Per set: the reason why it has no stable body; empty if it has one.
  std::vector<std::string> refusals;
  std::vector<ComparedLandmark> landmarks;
  double solve_seconds = 0;  ///< time of solving the sets

  /// One row per model (as scanned, each set, the one found) with mean, rms, 95th percentile and
  /// largest error in mm.
  Table summary() const;
};

/// Errors of landmarks that were fitted, and of `judged` ones that were not. All sets use the
/// identified motion of the rib cage. `mesh` is the one given to identify.
Comparison compare_sets(const HexMesh& mesh, const Observations& seen,
                        const std::vector<SeenPoint>& judged, const Identified& found,
                        const std::vector<ComparedSet>& sets, const IdentifyOptions& options,
                        Progress& progress = no_progress());

}  // namespace breast
