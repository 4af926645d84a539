// SPDX-License-Identifier: GPL-3.0-or-later
// Otsu's threshold of a histogram: N. Otsu, "A threshold selection method from gray-level
// histograms", IEEE Trans. Syst. Man Cybern. 9 (1979) 62-66.
#pragma once

#include <vector>

namespace breast {

/// The first class above the threshold of a histogram whose classes, in ascending order, hold
/// `count` values; `otherwise` if all values are in one class, or there are none.
int otsu_class(const std::vector<double>& count, int otherwise);

}  // namespace breast
