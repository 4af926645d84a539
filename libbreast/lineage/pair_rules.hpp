// SPDX-License-Identifier: GPL-3.0-or-later
// The table of the pairs of files that meet in one tool, and of what must agree between them.
#pragma once

#include <string>
#include <vector>

namespace breast {

/// What two files can have in common.
enum class Shared {
  scan,      ///< both come from one scan
  side,      ///< both are of the left or of the right breast
  geometry,  ///< both show one body at one place in the frame of the scan
  mesh,      ///< both have the elements and the imaged nodes of one mesh
  model,     ///< both were solved with one model: its texts and the stress-free shape
  patient,   ///< both state one Patient ID
};
/// "scan", "side" ...
std::string shared_name(Shared what);

/// The files are named as the tool's arguments are.
struct PairRule {
  std::string tool, first, second;
  std::vector<Shared> must_agree;
  std::vector<Shared> may_differ = {};  ///< those that --accept-other lets differ
};

const std::vector<PairRule>& pair_rules();
/// The row of the table. Throws std::logic_error if there is none.
const PairRule& pair_rule(const std::string& tool, const std::string& first,
                          const std::string& second);

/// What the option --accept-other of this tool takes, and its help.
std::vector<std::string> acceptable(const std::string& tool);
std::string accept_other_help(const std::string& tool);

/// The table as a page of docs/, with the rows of all tools or, if `tool` is not empty, of one.
std::string pairs_page(const std::string& tool = "");

}  // namespace breast
