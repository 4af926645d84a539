// SPDX-License-Identifier: GPL-3.0-or-later
// Label maps as input of tools: our own files, segmentations of 3D Slicer, and volumes of other
// programs.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "image/segments.hpp"
#include "tool_pairs.hpp"

namespace breast {

/// The options about labels from another program.
struct LabelChoices {
  std::vector<std::string> codes;
  std::string side;
  std::filesystem::path native;
  std::string accept_other;
};

/// Declares --code, --side, --native and --accept-other for the tool `name`.
void declare_label_choices(Tool& tool, const std::string& name, LabelChoices& choices);

/// Labels with all data that the stages of the chain need, and the origin of the native labels from
/// which they were completed.
struct LabelInput {
  LabelVolume labels;
  History native_history;
  std::string native_sha256;
};
/// Reads labels. Throws Error (input) for an unknown segment or code, labels without a side, a map at
/// another position, and native labels from which the others were not made.
LabelInput read_label_input(const std::filesystem::path& file, const LabelChoices& choices,
                            Pairs& pairs, Run& run);
/// The input files, for Run::history.
std::vector<Run::Input> inputs_of(const std::filesystem::path& file, const LabelChoices& choices,
                                  const LabelInput& input);

/// Reads only the tissues of any label map, and what it says of its origin. Remarks on how it was read go to
/// the run's user. `unnamed`: the codes of a map whose values have no names, instead of `codes`.
LabelVolume read_tissues(const std::filesystem::path& file, const TissueCodes& codes, Run& run,
                         const std::function<TissueCodes(const Volume<float>&)>& unnamed = nullptr);

}  // namespace breast
