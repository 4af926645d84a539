// SPDX-License-Identifier: GPL-3.0-or-later
// HTML pages of a cohort: an overview of all cases and the contours of their segmentations.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Pictures reduced in size, as the bytes of a JPEG; "" if the picture does not exist or cannot be
/// reduced.
struct Thumbnails {
  bool possible = true;  ///< if false, the page says that there are no pictures
  std::function<std::string(const std::filesystem::path& png, int width)> small;
  std::function<std::string(const std::filesystem::path& contours)>
      slices;  ///< five of the slices that segment draws
};

struct CohortPages {
  std::filesystem::path runs;
  Table cases;                  ///< from cohort_table
  Table cost;                   ///< from cohort_cost
  std::optional<Table> motion;  ///< one row per case
  Table women;                  ///< columns quantity, mean, sd, measured on living women
  Thumbnails pictures;
};

/// The numbers of a column with their mean, standard deviation and range.
struct Distribution {
  std::vector<double> values;  ///< in ascending order
  double mean = 0, sd = 0;
};
Distribution distribution_of(std::vector<double> values);

/// The overview page: failures first, with reason and log; distributions beside the values of
/// living women; then a row and a picture for every case.
std::string cohort_page(const CohortPages& cohort);
/// The page with the contours of every segmentation, beginning with those that failed or should be
/// checked.
std::string contours_page(const CohortPages& cohort);

}  // namespace breast
