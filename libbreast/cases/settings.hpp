// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of a run of the pipeline: checked before make expands them, completed from the case
// file and the defaults, and converted to variables of make.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace breast {

/// What make knows before any setting has a meaning.
struct SettingsRequest {
  using Values = std::map<std::string, std::string>;

  std::filesystem::path pipelines;  ///< folder of settings.tsv and goals.tsv
  std::string programs;             ///< folder of the programs, as make writes it
  bool installed = false;           ///< false in a source tree
  std::vector<std::string> goals;
  Values command_line;  ///< names given to make, with their values before any expansion
  Values environment;   ///< the same of the environment; names that are not settings are ignored
};

/// Lines of make that define every setting which the command line and the environment do not
/// define, and what follows from the settings:
///   known_settings, case_settings     names of all settings, and of those of a case file
///   RUN, scan, slides, body_slides    folder and scan of the case; whether the material set and
///                                     the body of the phantom slide on the chest wall
///   PHANTOM_MR, PHANTOM_TRUTH, TRUTH  files of the phantom; TRUTH is empty for a scan
///   no_tumour                         not empty if the case has no tumour to follow
///   prior_set, whole_set              the material set before an identification, and before the
///                                     gland was left out
/// The command line overrides a case file, which overrides the environment. Throws Error (input),
/// in one sentence that names the setting or the goal, for an unknown setting, for a value that is
/// refused, for a case file that is refused, for a goal that this case cannot have
/// (pipelines/goals.tsv), and for a folder that belongs to another scan.
std::string settings_for_make(const SettingsRequest& request);

}  // namespace breast
