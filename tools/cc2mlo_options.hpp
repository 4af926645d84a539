// SPDX-License-Identifier: GPL-3.0-or-later
// What cc2mlo is asked on the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "align/match_question.hpp"
#include "cli/tool.hpp"

namespace breast {

struct MatchChoices {
  MatchQuestion question;
  std::filesystem::path from, to;              ///< the two compressions
  std::filesystem::path curve, table, supine;  ///< outputs, and the shape a pair is followed to
  bool band = false;
  std::filesystem::path priors;  ///< of the band; empty: the default ones
  std::string materials;         ///< whose covariance the band counts; empty: none
  std::string geometry = "parallel";
  /// The patient's images and what is drawn and written for them.
  std::filesystem::path cc_image, mlo_image, picture, curve_table;
  std::vector<double> cc_nipple, mlo_nipple;  ///< pixels

  /// Throws Error (input) for options that do not go together.
  void check() const;
};

/// All options of the tool, its description and examples.
void declare_match(Tool& tool, MatchChoices& choices);

}  // namespace breast
