// SPDX-License-Identifier: GPL-3.0-or-later
// How often a band holds the true place, and how sure that figure is.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// A share with its 95 % interval, per cent.
struct Share {
  double percent = 0, from = 0, to = 0;
};
/// Of `held` among all places, each by sample: places of one sample err together, so that the interval is from the scatter of
/// the samples' own figures; of a single sample the binomial one (Wilson), as if its places were independent.
Share coverage(const std::vector<int>& held, const std::vector<int>& places);

/// The value below which `part` of the values lie: the one nearest in order; 0 of none.
double quantile(std::vector<double> values, double part);

struct BandPlace {
  std::string sample;
  double distance = 0;   ///< mm, of the true place across the curve
  double deviation = 0;  ///< mm, as the band says
};
struct BandRows {
  std::string name;
  std::vector<BandPlace> places;
  int failed = 0;  ///< samples without a solution
};
/// What band_check and band_truth print: sample, place, distance, deviation a line; "# sample ..." of one that failed.
/// Throws Error (input) naming line and file.
BandRows read_band_rows(const std::string& text, const std::string& name);
/// A row a file: samples solved and failed, places, how many of them the 50 and 95 % bands hold, with the 95 % interval of
/// these figures, root mean square distance in truth and as the band says, quantiles over the band's half-widths.
Table coverage_table(const std::vector<BandRows>& files);

}  // namespace breast
