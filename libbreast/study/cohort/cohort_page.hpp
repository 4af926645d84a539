// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of a cohort to look through and to send.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Pictures made small, as bytes of a JPEG; "" where there is none or it cannot be made.
struct Thumbnails {
  bool possible = true;  ///< false: the page says that there are no pictures
  std::function<std::string(const std::filesystem::path& png, int width)> small;
  std::function<std::string(const std::filesystem::path& contours)>
      slices;  ///< five of the slices that segment draws
};

struct CohortPages {
  std::filesystem::path runs;
  Table cases;                  ///< cohort_table
  Table cost;                   ///< cohort_cost
  std::optional<Table> motion;  ///< a row a case
  Table women;                  ///< quantity, mean, sd of living women
  Thumbnails pictures;
};

/// A column's numbers: how many, mean, standard deviation, range.
struct Distribution {
  std::vector<double> values;  ///< in order
  double mean = 0, sd = 0;
};
Distribution distribution_of(std::vector<double> values);

/// Failures first, with reason and log; distributions beside living women's values; then a row and a picture a case.
std::string cohort_page(const CohortPages& cohort);
/// The contours of every segmentation, those that failed or ask for a look first.
std::string contours_page(const CohortPages& cohort);

}  // namespace breast
