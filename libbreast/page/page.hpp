// SPDX-License-Identifier: GPL-3.0-or-later
// The interactive page as one HTML file: pointing at either view draws the curve, band and arc in
// the other, the slice of the MR and the column in the body. The file is complete and needs no
// server or network.
#pragma once

#include <string>

#include "image/volume.hpp"
#include "matching/lookup.hpp"
#include "projection/mammogram.hpp"

namespace breast {

struct PageContents {
  const Matcher& matcher;    ///< the two compressions; its landmarks and imaged shape are shown
  const MatchLookup& there;  ///< points of the first view
  const MatchLookup& back;   ///< points of the second view
  const Mammogram &from, &to;
  const Volume<float>* scan =
      nullptr;  ///< the breast's part of it is shown in slices; may be absent
};

inline constexpr std::size_t largest_page = 25000000;  ///< bytes

/// Images have pixels of at least 0.25 mm. Throws Error (input) if an image does not belong to its
/// view, if the lookups are not those of the two directions, if the scan does not cover the breast,
/// and for a page above largest_page.
std::string lookup_page(const PageContents& contents);

}  // namespace breast
