// SPDX-License-Identifier: GPL-3.0-or-later
// The points to be matched between two views, as given on a command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "matching/match_queries.hpp"
#include "matching/patient_views.hpp"

namespace breast {

/// Exactly one of these must be given. Points are in mm of the first image or, with the patient's
/// images, in pixels.
struct MatchQuestion {
  std::vector<double> point;            ///< u, v
  std::vector<double> pair;             ///< u, v in the first image, u, v in the second
  std::string landmark;                 ///< name in the meshes
  std::filesystem::path points, truth;  ///< tables, see point_queries and truth_queries
  int grid = 0;                         ///< N of N x N points over the tissue

  /// Throws Error (input) unless exactly one is given.
  void check() const;
  /// `behind` counts true positions beyond the edge of the first image. Throws Error (input), see
  /// the functions of match_queries.hpp.
  std::vector<MatchQuery> queries(const Matcher& matcher, const PatientViews* patient,
                                  int& behind) const;
};

}  // namespace breast
