// SPDX-License-Identifier: GPL-3.0-or-later
// Scans in which fat is suppressed: shown as one in which fat is bright.
#pragma once

#include <string>

#include "core/progress.hpp"
#include "core/report.hpp"
#include "segment/contrast/evidence.hpp"
#include "segment/work.hpp"

namespace breast {

/// Brightness of muscle relative to the suppressed fat in front of it, which decides whether the
/// chest wall can be seen: 2-8 mm behind it, in patches of 25 mm.
struct MuscleOverFat {
  double median = 0;  ///< of the patches
  double low = 0;     ///< fifth percentile of the patches
};

/// What is known of suppressed fat, on the working grid.
struct SuppressedFat {
  Volume<float> log_level;  ///< log brightness of suppressed fat
  Mask failed;              ///< where fat is not suppressed
  double failed_ml = 0;     ///< of that
  /// The largest share, in any round, of the tissue below the skin that lies within 10 mm of it.
  double near_failed = 0;
  double failed_brightness = 1;  ///< of that fat, relative to suppressed fat; 1 if there is none
  double water = 1.35;           ///< brightness of muscle, as the wall is sought
  double gland = 0;              ///< brightness of the breast's bright end, once it is shown
  MuscleOverFat muscle;
};

/// Whether fat can be suppressed at all: skin, which holds water, is brighter than the tissue below
/// it, or too thin for the voxels to be measured.
bool may_be_suppressed(const FatContrast& contrast);
/// Says that it cannot.
std::string refusal_of_skin(const FatContrast& contrast);

/// Finds fat's level, bias and wall. The scan of `work`, in which fat is suppressed, becomes one in
/// which fat is the bright tissue, and on which all stages run as on a T1-weighted scan.
SuppressedFat find_suppressed_wall(Work& work, Progress& progress, Timer& timer);

/// Once the wall is known, shows gland instead of muscle as the tissue that holds water: in `work`,
/// whose working scan was `scan`, and in `images`, whose tissue becomes its outline.
void show_gland(Work& work, const Volume<float>& scan, Images& images, SuppressedFat& fat);

/// What muscle shows a scan to be in which fat is not bright: fat is suppressed, or does not show at all, as in the water
/// image of a Dixon scan, where muscle is more than 4.5 times as bright. Unknown where muscle is less than 1.2 times as bright as fat,
/// or nothing is left in which it could be measured.
enum class DarkFat { unknown, suppressed, silent };
DarkFat dark_fat(const SuppressedFat& fat);

/// States why the wall cannot be taken from a scan with suppressed fat, without the ways out; empty if it can. Where
/// muscle is less than 1.2 times as bright as fat, or less bright than fat in some place, the
/// errors of the wall grow from below one millimetre to centimetres while its confidence stays.
/// More than 4.5 times, nothing but water is left, which suppression does not reach. Where fat is not
/// suppressed in some place, its level is less sure elsewhere too, and muscle has to be 1.7 times as bright.
std::string refusal_of(const SuppressedFat& fat);

/// Where fat is not suppressed, it is hardly told from gland, and the level beside it may not hold: within 10 mm of
/// it the wall's confidence falls below one half, and its standard deviation grows by 6 mm.
void doubt_wall_by_failed(Work& work, const SuppressedFat& fat);
/// A sentence that states where in the body fat is not suppressed (a box in patient mm); empty if all fat is
/// suppressed.
std::string doubt_of_failed(const SuppressedFat& fat);

}  // namespace breast
