// SPDX-License-Identifier: GPL-3.0-or-later
// Matched curves for a grid of points over a whole image, for interactive lookup.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "core/provenance.hpp"
#include "matching/band.hpp"
#include "matching/correspondence.hpp"

namespace breast {

enum class LookupStatus : std::uint8_t {
  air = 0,
  matched = 1,
  through_chest_wall = 2,
  behind_image = 3
};

/// Node (i,j) of the grid is the point (i,j) · pitch of the first image. Its curve has `samples`
/// points at equal distances in the column. Arrays run over j, i and sample, and contain 0 in air.
struct MatchLookup {
  View from_view = View::cc, to_view = View::mlo;
  Side side = Side::left;
  double pitch = 0;  ///< mm
  int nu = 0, nv = 0, samples = 0;
  std::vector<std::uint8_t> status;  ///< LookupStatus, per node
  std::vector<float> depth;          ///< mm of tissue, per node
  std::vector<float> length;         ///< mm of the curve, per node
  std::vector<float> curve;          ///< u, v in the second image, mm
  std::vector<float> deviation;  ///< mm, one standard deviation across the curve (0 without band)
  std::vector<float> imaged;     ///< x, y, z of the column in the MR frame, mm
  std::vector<std::string> band_without;  ///< priors that the deviation does not include
  History history;

  std::size_t node(int i, int j) const { return std::size_t(j) * std::size_t(nu) + std::size_t(i); }
};

/// Computes the curves of a grid. Throws Error (input) for a pitch that is not positive or gives
/// more than a million nodes.
MatchLookup match_lookup(const Matcher& matcher, const BandModel* band, double pitch,
                         int samples = 25, Progress& progress = no_progress());

}  // namespace breast
