// SPDX-License-Identifier: GPL-3.0-or-later
// Label maps as tools take them: our own files, segmentations of 3D Slicer, volumes of other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "image/segments.hpp"

namespace breast {

/// What a tool is told about labels that are not its own.
struct LabelChoices {
  std::vector<std::string> codes;
  std::string side;
  std::filesystem::path native;
};

/// --code, --side and --native.
void declare_label_choices(Tool& tool, LabelChoices& choices);

/// Labels with all that the stages of the chain need, and what the native ones they were completed from are.
struct LabelInput {
  LabelVolume labels;
  History native_history;
  std::string native_sha256;
};
/// Throws Error (input) for an unknown segment or code, labels without a side, and a map that lies elsewhere.
LabelInput read_label_input(const std::filesystem::path& file, const LabelChoices& choices);
/// The files of it, for Run::history.
std::vector<Run::Input> inputs_of(const std::filesystem::path& file, const LabelChoices& choices,
                                  const LabelInput& input);

/// The tissues alone, of any label map; `sha256` (may be null) receives the hash of its content.
LabelVolume read_tissues(const std::filesystem::path& file, const TissueCodes& codes,
                         std::string* sha256 = nullptr);

}  // namespace breast
