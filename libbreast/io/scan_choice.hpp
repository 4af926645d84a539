// SPDX-License-Identifier: GPL-3.0-or-later
// Which scan of a DICOM folder is meant.
#pragma once

#include <optional>

#include "core/types.hpp"

namespace breast {

struct ScanChoice {
  int series = 0;            ///< its number in the list of the folder's series, from 1; 0: the best
  std::optional<Side> side;  ///< the breast that it must show

  ScanChoice(int series_number = 0, std::optional<Side> breast = std::nullopt)
      : series(series_number), side(breast) {}
};

/// How the best series is found, as help texts say it.
inline constexpr const char* series_rule =
    "of the series that are volumes and no localisers, those come first that extend over at least 60 mm along "
    "every axis, then those with the better contrast by their header (T1, in phase, not stated, T1 "
    "fat-suppressed, water, T2, others), then what is no secondary image, then the earlier time point, then "
    "those with voxels smaller by 5 %; of two that are still equal one must be asked for by its number";

}  // namespace breast
