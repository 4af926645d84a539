// SPDX-License-Identifier: GPL-3.0-or-later
// The contrast of an MR image as its header states it.
#pragma once

#include <functional>
#include <string>

namespace breast {

/// In the order in which a scan is preferred for segmentation: fat bright against muscle and gland first.
enum class ScanContrast {
  t1,
  in_phase,
  unknown,
  t1_fat_suppressed,
  water,
  t2,
  t2_fat_suppressed,
  opposed_phase,
  fat,
  diffusion,
  subtraction,
  phase,
  map,
  projection,
};
/// "T1", "T1 fat-suppressed", "water", ...; "not stated".
const char* contrast_name(ScanContrast contrast);

/// The contrast by Image Type, sequence, times, options and, where these are silent, the words of the description
/// that name contrasts ("w/o FS" is no water image). `value` gives an element by its key ("0018|0081") or "".
ScanContrast contrast_of(const std::function<std::string(const char*)>& value);

}  // namespace breast
