// SPDX-License-Identifier: GPL-3.0-or-later
// Check that fat is the bright tissue, as in T1-weighted scans without fat saturation.
#pragma once

#include <string>

namespace breast {

struct Work;

/// Quantities that distinguish scans in which fat is bright from those in which it is saturated.
struct FatContrast {
  /// 90th percentile, over the breast's skin, of its brightness relative to the subcutaneous tissue
  /// nearby: skin is darker than fat, and brighter than saturated fat.
  double skin_to_subcutis = 0;
  /// Median, over the tissue 4-8 mm below the skin, of its brightness relative to the brightest
  /// within 25 mm.
  double subcutaneous = 1;
  double fat_cv = 0;        ///< coefficient of variation of fat after the bias correction
  double muscle_ratio = 0;  ///< brightness behind the chest wall relative to fat
};

/// Computes the first two quantities, which only need the scan and the body, from skin at most
/// `behind_sternum` mm behind that over the sternum (in front of the sternum there is only breast).
FatContrast contrast_below_skin(const Work& work, double behind_sternum = 0);

/// Evidence of saturated fat: the sum of a score for each of the four quantities, from 0 at the
/// limit of scans with bright fat to 1 at the value of a saturated scan. A scan with more than
/// `most_evidence` is refused, which takes at least two abnormal quantities, or subcutaneous tissue
/// darker than a third.
double saturation_evidence(const FatContrast& contrast);
constexpr double most_evidence = 1.3;

/// One sentence that states why a scan is refused because of its contrast; empty if fat is bright.
std::string refusal_of(const FatContrast& contrast);

}  // namespace breast
