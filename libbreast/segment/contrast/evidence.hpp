// SPDX-License-Identifier: GPL-3.0-or-later
// Which tissue is bright in a scan: fat, as in T1-weighted scans, or what holds water.
#pragma once

#include <string>

#include "core/units.hpp"

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
  /// Share of the columns in which the image shows the chest wall, and its distance (mm) behind the
  /// skin over the sternum: where muscle is as bright as fat, lung is taken for it.
  double wall_seen = 1, sternal_thickness = 0;
  /// Share of the breast, with what is as dark as air in it, that has less than 0.15 of the greatest
  /// brightness within 25 mm: fat in a water image, all else in a fat image. What an implant may be
  /// (a ball of 15 mm fits into it) does not count.
  double silent_share = 0;
  bool skin_resolved = true;  ///< voxels are so small that the skin's brightness says anything
};

/// Computes the quantities that only need the scan and the body, from skin at most
/// `behind_sternum` mm behind that over the sternum (in front of the sternum there is only breast).
FatContrast contrast_below_skin(const Work& work, double behind_sternum = 0);

/// Adds what follows from the chest wall of a prone breast.
void complete_contrast(FatContrast& contrast, const Work& work, Side side);

/// Evidence of saturated fat: the sum of a score for each quantity, from 0 at the limit of scans with
/// bright fat to 1 at the value of a saturated scan. A scan with more than `most_evidence` is
/// refused, which takes at least two abnormal quantities, subcutaneous tissue darker than a third, or a deep sternum where the skin
/// is not resolved.
double saturation_evidence(const FatContrast& contrast);
constexpr double most_evidence = 1.15;

/// States why a scan is refused because of its contrast, without the ways out; empty if fat is bright.
std::string refusal_of(const FatContrast& contrast);

/// States why a scan is taken for the water or the fat image of a Dixon scan alone, without the ways out; empty if it
/// is none.
std::string refusal_of_half(const FatContrast& contrast);

}  // namespace breast
