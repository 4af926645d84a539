// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_input.hpp"

#include <optional>

#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "io/label_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

bool is_native(const fs::path& file) {
  return file.extension() == ".vtkhdf";
}

std::optional<Side> side_of(const LabelChoices& choices) {
  return choices.side.empty() ? std::nullopt : std::optional(side_from_name(choices.side));
}

// A volume of codes without names, for which the user must state the side.
LabelVolume coded_labels(const fs::path& file, const LabelChoices& choices, Run& run) {
  const auto side = side_of(choices);
  if (!side && choices.native.empty()) {
    throw input_error(file.string(),
                      ": does not state which breast it shows: give --side left or right");
  }
  LabelVolume labels = read_tissues(file, parse_tissue_codes(choices.codes), run);
  if (side) labels.side = *side;
  for (const std::uint8_t tissue : labels.tissue)
    labels.fibroglandular_fraction.push_back(Tissue(tissue) == Tissue::fibroglandular ? 1.0F
                                                                                      : 0.0F);
  return labels;
}

struct ForeignLabels {
  LabelVolume labels;
  bool states_side = true;  ///< otherwise it is that of the native labels
};

SegmentedVolume read_segments(const fs::path& file, Run& run) {
  SegmentedVolume segmentation = read_segmentation(file);
  if (!segmentation.remark.empty()) run.remark(segmentation.remark);
  return segmentation;
}

ForeignLabels foreign_labels(const fs::path& file, const LabelChoices& choices, Run& run) {
  std::optional<Side> side = side_of(choices);
  if (!is_segmentation_file(file)) return {coded_labels(file, choices, run), side.has_value()};
  const SegmentedVolume segmentation = read_segments(file, run);
  if (!side) side = tagged_side(segmentation.segments);
  const bool states_side = side.has_value();
  if (!side && !choices.native.empty()) side = Side::left;
  return {labels_of(segmentation, parse_tissue_codes(choices.codes), side, file.string()),
          states_side};
}

}  // namespace

void declare_label_choices(Tool& tool, const std::string& name, LabelChoices& choices) {
  tool.texts(
      choices.codes, "--code", "NUMBER=TISSUE|NAME=TISSUE|PRESET",
      "tissue of a value or of a segment in labels from another program, such as 3=skin, wall=3 "
      "or 'Pectoralis=wall'; the tissues are air, fat, fibroglandular, skin, muscle (or wall), "
      "tumour, other. Instead, the name of a table of such pairs: " +
          join(code_preset_names(), ", ") + " (pipelines/codes), or a file like these");
  tool.choice(choices.side, "--side", {"left", "right"},
              "breast that the labels show; needed only for labels from another program "
              "(segmentations of export-slicer state it)");
  tool.input_file(
      choices.native, "--native", "LABELS.vtkhdf",
      "original labels of segment, if LABELS is a corrected copy from another program; the grid "
      "and what such a copy lacks (fibroglandular fraction where the tissue is unchanged, "
      "confidence of the chest wall, nipple, skin, midline) are taken from them");
  declare_accept_other(tool, name, choices.accept_other);
  tool.topic("labels from another program", {"--code", "--side", "--native", "--accept-other"});
}

LabelVolume read_tissues(const fs::path& file, const TissueCodes& codes, Run& run,
                         const std::function<TissueCodes(const Volume<float>&)>& unnamed) {
  if (is_native(file)) return read_labels(file);
  LabelVolume labels;
  if (is_segmentation_file(file)) {
    const SegmentedVolume segmentation = read_segments(file, run);
    labels = translate_labels(segmentation.values,
                              codes_of(segmentation.segments, codes, file.string()), file.string());
    labels.content_sha256 = segmentation.content_sha256;
    labels.scan_sha256 = tagged_scan(segmentation.segments);
    return labels;
  }
  VolumeSource source;
  const Volume<float> volume = read_volume(file, 0, &source);
  labels = translate_labels(volume, unnamed ? unnamed(volume) : codes, file.string());
  labels.content_sha256 = source.content_sha256;
  return labels;
}

LabelInput read_label_input(const fs::path& file, const LabelChoices& choices, Pairs& pairs,
                            Run& run) {
  LabelInput input;
  if (is_native(file)) {
    if (!choices.codes.empty() || !choices.side.empty() || !choices.native.empty()) {
      throw input_error(file.string(),
                        ": is a label file of libbreast, which takes no --code, --side or "
                        "--native");
    }
    input.labels = read_labels(file);
    return input;
  }
  ForeignLabels foreign = foreign_labels(file, choices, run);
  input.labels = std::move(foreign.labels);
  if (choices.native.empty()) return input;
  const LabelVolume native = read_labels(choices.native);
  const Origin origin = origin_of(choices.native, native);
  pairs.check("LABELS", origin_of(file, input.labels, foreign.states_side), "--native", origin);
  const std::string sha256 = input.labels.content_sha256;
  input.labels = completed_labels(input.labels, native, file.string());
  input.native_history = native.history;
  input.native_sha256 = native.content_sha256;
  input.labels.content_sha256 = sha256;
  input.labels.scan_sha256 = scan_behind(origin);
  input.labels.history.clear();
  return input;
}

std::vector<Run::Input> inputs_of(const fs::path& file, const LabelChoices& choices,
                                  const LabelInput& input) {
  std::vector<Run::Input> list{{file, input.labels.content_sha256, &input.labels.history}};
  if (!choices.native.empty()) {
    list.push_back({choices.native, input.native_sha256, &input.native_history});
  }
  return list;
}

}  // namespace breast
