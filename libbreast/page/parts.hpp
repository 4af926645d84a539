// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the page's data, each as one JavaScript literal.
#pragma once

#include <string>
#include <string_view>

#include "image/volume.hpp"
#include "matching/lookup.hpp"
#include "mesh/hex_mesh.hpp"
#include "projection/mammogram.hpp"

namespace breast {

/// "[1.5,2,3]".
std::string numbers_json(const std::vector<double>& values);

/// The picture in clinical orientation, 16 bits, with every n-th pixel so that pixels are at least
/// a quarter millimetre, and the landmarks of `compressed` in it.
std::string image_json(const Mammogram& image, const HexMesh& compressed);

/// The curves of a grid, only for nodes in tissue, rounded to 0.01 mm; coordinates are limited to
/// 327 mm from `middle` (columns) or from the corner of the image (curves). A grid
/// with more than 14 000 nodes in tissue is thinned, so that a direction takes at most 7 MB.
std::string lookup_json(const MatchLookup& lookup, const Vec3& middle);

/// Edges of skin, chest wall and cut in the MR frame, mm, with nipple and tumour.
std::string body_json(const HexMesh& mesh);

/// The scan in the box of the imaged breast and 15 mm about it, so that it contains only the part
/// of the patient that the page shows: 8 bits between the 1st and the 99.5th percentile, axes along
/// the patient's, voxels of at least 1 by 1 by 2 mm, at most 4 MB. Throws Error (input) when the
/// scan and the breast do not overlap.
std::string scan_json(const Volume<float>& scan, const HexMesh& mesh);

/// Corners of the box of the imaged shape, mm.
struct Box {
  Vec3 low, high;
  Vec3 middle() const { return (low + high) / 2; }
};
Box imaged_box(const HexMesh& mesh);

}  // namespace breast
