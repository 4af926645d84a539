// SPDX-License-Identifier: GPL-3.0-or-later
// Voigt order of a symmetric tensor: 11, 22, 33, 12, 23, 13.
#pragma once

namespace breast {

/// Component r in Voigt order is that of row voigt_row[r] and column voigt_column[r].
inline constexpr int voigt_row[6] = {0, 1, 2, 0, 1, 0}, voigt_column[6] = {0, 1, 2, 1, 2, 2};

}  // namespace breast
