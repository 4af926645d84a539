// SPDX-License-Identifier: GPL-3.0-or-later
// Tags and lengths that delimit the items of a sequence (DICOM PS3.5 section 7.5).
#pragma once

#include <cstdint>

namespace breast {

/// Group in the upper 16 bits, element in the lower.
inline constexpr std::uint32_t item_tag = 0xfffee000, item_end_tag = 0xfffee00d,
                               sequence_end_tag = 0xfffee0dd;
/// Length of a sequence or item that ends with its delimiter.
inline constexpr std::uint32_t undefined_length = 0xffffffff;

}  // namespace breast
