// SPDX-License-Identifier: GPL-3.0-or-later
// The command-line options of cc2mlo.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "matching/match_question.hpp"

namespace breast {

struct MatchChoices {
  MatchQuestion question;
  std::filesystem::path from, to;  ///< the two compressions
  /// Outputs, and the shape to which a pair is followed.
  std::filesystem::path curve, table, supine;
  bool band = false;
  std::filesystem::path priors;  ///< priors of the band; empty for the default ones
  /// Material set with the covariance used for the band; empty: that of the files' model.
  std::string materials;
  std::string geometry = "parallel", accept_other;
  /// The patient's images, and the outputs for them.
  std::filesystem::path cc_image, mlo_image, picture, cc_hung, mlo_hung, curve_table;
  std::vector<double> cc_nipple, mlo_nipple;  ///< in pixels

  /// Throws Error (input) if options contradict each other.
  void check() const;
};

/// Declares all options of the tool, its description and examples.
void declare_match(Tool& tool, MatchChoices& choices);

}  // namespace breast
