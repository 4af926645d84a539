// Label volumes with somebody else's tissue codes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "image/label_volume.hpp"

namespace breast {

/// Foreign code -> our tissue; empty: the codes are ours.
using TissueCodes = std::map<int, Tissue>;

/// From texts like "29=fibroglandular"; throws Error (input) beginning with "--code".
TissueCodes parse_tissue_codes(const std::vector<std::string>& texts);

/// With a table of codes, what it does not name becomes `other` (0: air). Without, throws Error
/// (input) beginning with `name` at the first voxel that is none of our codes.
LabelVolume translate_labels(const Volume<float>& volume, const TissueCodes& codes,
                             const std::string& name);

/// Turns breast tissue outside the region into `other`. The region, on any grid, is where its value
/// is `code`, or any but 0 when `code` is 0.
void restrict_breast(LabelVolume& labels, const Volume<float>& region, int code);

/// Nipple of a foreign volume: the point of the skin (patient mm) nearest to the centre of
/// the voxels of `volume` that hold `code` and are breast in `labels`, which lie on the
/// same grid; empty without any.
std::optional<Vec3> skin_over_code(const Volume<float>& volume, int code,
                                   const LabelVolume& labels);

}  // namespace breast
