// SPDX-License-Identifier: GPL-3.0-or-later
// The columns of a minimum cut: a surface is sought on columns about 3.3 mm apart, and is linear between
// them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "segment/wall/chest_wall.hpp"

namespace breast {

struct CutColumns {
  int stride;  ///< columns of the grid from one of the cut to the next
  int count;   ///< in a slice, from the medial end of the domain

  /// `spacing`: of the grid's columns, mm.
  CutColumns(const WallDomain& domain, double spacing)
      : stride(std::max(1, int(std::lround(apart / spacing)))),
        count((domain.last - domain.first) / stride + 1) {}

  /// The grid's column at column `c` of the cut.
  int at(int c, const WallDomain& domain) const { return domain.from_medial(c * stride); }
  /// The value at the grid's column `i` of row `k` of values (`count` a row); beyond the last column
  /// of the cut it is that of the last.
  template <class Value>
  double between(const std::vector<Value>& values, int i, int k, const WallDomain& domain) const {
    const double x = double(domain.to_medial(i)) / stride;
    const int a = std::min(int(x), count - 1), b = std::min(a + 1, count - 1);
    const std::size_t row = std::size_t(k) * count;
    return values[row + a] + (x - a) * (values[row + b] - values[row + a]);
  }

 private:
  static constexpr double apart = 3.3;  // mm
};

}  // namespace breast
