// SPDX-License-Identifier: GPL-3.0-or-later
// Names and colours of tissues for programs that show segments, and the conversion of such names to
// tissue codes.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/label_volume.hpp"

namespace breast {

/// One segment of a segmentation: what voxels of `value` are.
struct Segment {
  std::string name;
  int value = 0;
  std::array<double, 3> colour{0.5, 0.5, 0.5};  ///< red, green, blue, 0 to 1
  std::map<std::string, std::string> tags;      ///< 3D Slicer keeps them when it saves
};

/// A segmentation as read: one value a voxel, and what the values are.
struct SegmentedVolume {
  Volume<float> values;
  std::vector<Segment> segments;
  std::string content_sha256;  ///< of grid and voxels
};

/// What foreign values, or segments of that name, are; empty: nothing was said.
struct TissueCodes {
  std::map<int, Tissue> values;
  std::map<std::string, Tissue> names;
  bool empty() const { return values.empty() && names.empty(); }
};

/// From texts like "29=fibroglandular", "wall=3" or "Pectoralis left=wall": a value or a segment's name on one side,
/// a tissue on the other, where "wall" is muscle. Throws Error (input) beginning with "--code".
TissueCodes parse_tissue_codes(const std::vector<std::string>& texts);

/// The segments of our labels: those tissues that occur, air left out. Tags hold tissue, side, nipple (LPS mm), measured
/// skin thickness and midline, so that the way back needs no other file.
std::vector<Segment> segments_of(const LabelVolume& labels);

/// Name and colour of a tissue's segment.
Segment segment_of(Tissue tissue);

/// Value to tissue: by --code, else by the tag of segments_of, else by name in any case ("Chest wall", "Skin", "Gland",
/// "Tumor" ...). Throws Error (input) beginning with `name` for a segment that none of these knows, and for one that
/// `codes` names and the file does not hold, naming the segments there are and the names that are known.
TissueCodes codes_of(const std::vector<Segment>& segments, const TissueCodes& codes,
                     const std::string& name);

/// With a table of codes, what it does not name becomes `other` (0: air). Without, throws Error (input) beginning with
/// `name` at the first voxel that is none of our codes.
LabelVolume translate_labels(const Volume<float>& volume, const TissueCodes& codes,
                             const std::string& name);

/// Labels of a segmentation: tissue by codes_of, gland's fraction 1 or 0, no confidence of the chest wall; side,
/// nipple, skin thickness and midline from the tags where they are. `side` (may be empty) overrides the tag; throws
/// Error (input) when neither is there.
LabelVolume labels_of(const SegmentedVolume& segmentation, const TissueCodes& codes,
                      const std::optional<Side>& side, const std::string& name);

/// `edited` on the grid of `native` (nearest voxel; air beyond), with what only native labels hold: the fraction of
/// gland where the tissue is the same, the confidence of the chest wall, side, landmarks, skin thickness, midline,
/// history. Throws Error (input) beginning with `name` where the two do not overlap.
LabelVolume completed_labels(const LabelVolume& edited, const LabelVolume& native,
                             const std::string& name);

}  // namespace breast
