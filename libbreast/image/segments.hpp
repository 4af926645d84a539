// SPDX-License-Identifier: GPL-3.0-or-later
// Names and colours of tissues for programs that show segments, and the conversion of such names to
// tissue codes.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/code_presets.hpp"
#include "image/label_volume.hpp"

namespace breast {

/// One segment of a segmentation: the meaning of voxels of `value`.
struct Segment {
  std::string name;
  int value = 0;
  std::array<double, 3> colour{0.5, 0.5, 0.5};  ///< red, green, blue, 0 to 1
  std::map<std::string, std::string> tags;      ///< 3D Slicer keeps them when it saves
};

/// A segmentation as read: one value per voxel, and the meaning of the values.
struct SegmentedVolume {
  Volume<float> values;
  std::vector<Segment> segments;
  std::string content_sha256;  ///< of grid and voxels
  std::string remark;          ///< what its user should know of how it was read; mostly ""
};

/// Tissues of another program's values or named segments; empty if none were given.
struct TissueCodes {
  std::map<int, Tissue> values;
  std::map<std::string, Tissue> names;
  CodePreset preset;  ///< where neither says anything; the file need not have all of it
  bool empty() const {
    return values.empty() && names.empty() && preset.values.empty() && preset.names.empty();
  }
};

/// Parses texts such as "29=fibroglandular", "wall=3" or "Pectoralis left=wall", which assign a
/// tissue to a value or to a segment's name; "wall" means muscle. A text without "=" is a preset or a table
/// of one (load_code_preset); of several the first counts. Throws Error (input) beginning with "--code".
TissueCodes parse_tissue_codes(const std::vector<std::string>& texts);

/// The segments of a label volume: the tissues that occur, except air. The tags contain tissue,
/// side, nipple (LPS mm), measured skin thickness, midline and the scan's content, so that the inverse
/// conversion needs no other file.
std::vector<Segment> segments_of(const LabelVolume& labels);

/// The side that the tags state, if any.
std::optional<Side> tagged_side(const std::vector<Segment>& segments);

/// The content of the scan that the tags state; "" if they state none.
std::string tagged_scan(const std::vector<Segment>& segments);

/// Name and colour of a tissue's segment.
Segment segment_of(Tissue tissue);

/// Maps values to tissues: by --code, otherwise by the tag of segments_of, otherwise by the preset's names,
/// otherwise by name, ignoring case and the _1 that 3D Slicer adds ("Chest wall", "Skin", "Gland", "Tumor"
/// ...). Throws Error (input) beginning with `name` for a segment that none of these identifies, and for one
/// that `codes` names but the file does not have, listing the existing segments and the known names.
TissueCodes codes_of(const std::vector<Segment>& segments, const TissueCodes& codes,
                     const std::string& name);

/// With a table of codes, values that it does not name become `other` (0: air). Without one, throws
/// Error (input) beginning with `name` at the first voxel that is not a tissue code; with a preset, if no
/// voxel has one of its values.
LabelVolume translate_labels(const Volume<float>& volume, const TissueCodes& codes,
                             const std::string& name);

/// The labels of a segmentation: tissue by codes_of, fibroglandular fraction 1 or 0, no confidence
/// of the chest wall; side, nipple, skin thickness, midline and scan from the tags, if present. `side`
/// (may be empty) overrides the tag; throws Error (input) if there is neither.
LabelVolume labels_of(const SegmentedVolume& segmentation, const TissueCodes& codes,
                      const std::optional<Side>& side, const std::string& name);

/// `edited` on the grid of `native` (nearest voxel; air beyond), with the data that only native
/// labels have: the fibroglandular fraction where the tissue is the same, the confidence of the
/// chest wall, side, landmarks, skin thickness, midline, history. Throws Error (input) beginning
/// with `name` where the two do not overlap.
LabelVolume completed_labels(const LabelVolume& edited, const LabelVolume& native,
                             const std::string& name);

}  // namespace breast
