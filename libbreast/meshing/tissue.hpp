// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue per element from segmented voxels, by volume fraction.
#pragma once

#include <array>

#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

struct TissueReport {
  std::array<double, n_tissues> volume{};  ///< mm³ per tissue, of whole elements
  double fibroglandular_volume = 0;        ///< mm³ by element fractions
  double gland_threshold = 0.5;            ///< smallest fraction of a fibroglandular element
  /// Part of the mesh's volume in voxels that are not breast.
  double outside_fraction = 0;
  double missed_fraction = 0;   ///< part of the segmented breast's volume outside the mesh
  double segmented_volume = 0;  ///< mm³ of breast voxels (fat, fibroglandular, skin, tumour)
};

/// Fills tissue and fibroglandular_fraction from 3³ samples per element at the imaged positions,
/// weighted by their volumes. Samples outside the breast are ignored; an element without any breast
/// sample is fat. The elements with the largest fractions become fibroglandular, in such a number
/// that their volume equals the sum of the fractions, with the threshold limited to 0.1 to 0.7. (A
/// threshold of one half would lose thin ducts, in which the fraction never reaches a half.) An
/// element with at least half tumour is tumour; elements of a skin layer remain skin. Throws Error
/// (input) if the labels contain no breast, are of the other side, or do not overlap the mesh.
TissueReport assign_tissue(const LabelVolume& labels, HexMesh& mesh);

/// The tissue volumes of the mesh in its present state, for example after adding a tumour.
std::array<double, n_tissues> tissue_volumes(const HexMesh& mesh);

}  // namespace breast
