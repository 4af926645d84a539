// SPDX-License-Identifier: GPL-3.0-or-later
// Landmarks as several material sets put them into the second posture.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "identification/identify.hpp"

namespace breast {

/// A set to be compared with the one found: its own law, skin and supports.
struct ComparedSet {
  std::string name;
  MechanicsOptions mechanics;
};

/// How far each landmark moved and how far from where it was seen each set puts it, mm.
struct ComparedLandmark {
  std::string name;
  bool fitted = false;  ///< used to identify: the set found is judged with it left out
  double moved = 0, found = 0;
  std::vector<double> sets;  ///< in order of the sets; not a number where a set has no stable body
};

struct Comparison {
  std::vector<std::string> sets;
  std::vector<std::string> refusals;  ///< per set: why it has no stable body; empty where it has
  std::vector<ComparedLandmark> landmarks;
  double solve_seconds = 0;  ///< of the sets

  /// A row a model: as scanned, each set, the one found; mean, rms, 95th percentile and largest error in mm.
  Table summary() const;
};

/// Errors of landmarks that were fitted and of `judged` ones that were not. All sets are given the rib cage's motion
/// that was found. `mesh` is the one identify was given.
Comparison compare_sets(const HexMesh& mesh, const Observations& seen,
                        const std::vector<SeenPoint>& judged, const Identified& found,
                        const std::vector<ComparedSet>& sets, const IdentifyOptions& options,
                        Progress& progress = no_progress());

}  // namespace breast
