// SPDX-License-Identifier: GPL-3.0-or-later
// How a scan is refused whose contrast does not show the chest wall: the reasons, and one list of ways out.
#pragma once

#include <string>

#include "segment/contrast/evidence.hpp"
#include "segment/contrast/suppressed.hpp"

namespace breast {

/// Why the wall of a scan with suppressed fat cannot be taken from it, `shown` as one with bright fat; empty if it can.
std::string refusal_of_suppressed(const SuppressedFat& fat, const FatContrast& shown);

/// With these words the ways out begin in a refusal.
inline constexpr const char* ways_out_begin = ": give ";

/// ": give ...": what a user can do where no contrast is found that shows the wall, or if the scan may be half of a
/// Dixon scan. A chest wall serves where a scan can have suppressed fat.
std::string ways_out(bool half_of_dixon, bool by_wall = true);

/// Refuses a scan that is read neither with bright fat (why: `bright`; `half`: as it has silent parts) nor with
/// suppressed fat (why: `suppressed`). Where muscle shows that fat is suppressed, it is not half of a Dixon scan.
std::string refusal_of_both(const std::string& bright, bool half, const std::string& suppressed,
                            DarkFat found);

}  // namespace breast
