// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of a block pressed between plates with CalculiX's solution of the same scene.
#pragma once

#include <string>

#include "core/table.hpp"

namespace breast {

/// The result of CalculiX for a scene.
struct PressedByCalculix {
  std::string scene;
  double gap_percent = 0;  ///< requested gap, in per cent of the block's height
  double reached = 0;      ///< fraction of the plates' motion that was reached, 0 to 1
  std::string force_N;     ///< force on the upper plate, as printed
  int iterations = 0;
  double cpu_s = 0;
};
/// One row that compares it with `ours`, the output of bench_pressed_block: the last row of that
/// output is the requested state; its seconds and iterations are the sums over all rows.
Table pressed_table(const PressedByCalculix& theirs, const Table& ours);

}  // namespace breast
