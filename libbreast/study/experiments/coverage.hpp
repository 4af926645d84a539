// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage of a band, that is, how often it contains the true position, with its confidence
// interval.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// A percentage with its 95 % interval.
struct Share {
  double percent = 0, from = 0, to = 0;
};
/// The percentage of `held` among all places, both given per sample. Errors of places in one sample
/// are correlated, so that the interval is computed from the scatter between samples. For a single
/// sample it is the binomial interval (Wilson), as if its places were independent.
Share coverage(const std::vector<int>& held, const std::vector<int>& places);

/// The value below which the fraction `part` of the values lies, as the nearest value in ascending
/// order; 0 if there are no values.
double quantile(std::vector<double> values, double part);

struct BandPlace {
  std::string sample;
  double distance = 0;   ///< distance of the true position across the curve, mm
  double deviation = 0;  ///< standard deviation according to the band, mm
};
struct BandRows {
  std::string name;
  std::vector<BandPlace> places;
  int failed = 0;  ///< number of samples without a solution
};
/// Reads the output of band_check and band_truth: lines with sample, place, distance and deviation,
/// and "# sample ..." for a sample that failed. Throws Error (input) naming line and file.
BandRows read_band_rows(const std::string& text, const std::string& name);
/// One row per file: solved and failed samples; places, and the percentages of them inside the 50
/// and 95 % bands with their 95 % intervals; root mean square distance, true and according to the
/// band; quantiles divided by the band's half-widths.
Table coverage_table(const std::vector<BandRows>& files);

}  // namespace breast
