// SPDX-License-Identifier: GPL-3.0-or-later
// A block between plates, by CalculiX and by ours.
#pragma once

#include <string>

#include "core/table.hpp"

namespace breast {

/// What CalculiX said of a scene.
struct PressedByCalculix {
  std::string scene;
  double gap_percent = 0;  ///< asked for, of the block's height
  double reached = 0;      ///< part of the plates' way, 0 to 1
  std::string force_N;     ///< on the upper plate, as printed
  int iterations = 0;
  double cpu_s = 0;
};
/// One row beside `ours`, what bench_pressed_block printed: its last row is the state asked for, its seconds and iterations
/// are those of all rows.
Table pressed_table(const PressedByCalculix& theirs, const Table& ours);

}  // namespace breast
