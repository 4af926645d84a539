// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/pressed.hpp"

#include "core/error.hpp"
#include "study/cells.hpp"

namespace breast {

Table pressed_table(const PressedByCalculix& theirs, const Table& ours) {
  if (ours.rows.empty()) throw input_error(ours.name, ": has no rows");
  double newton = 0, seconds = 0;
  for (std::size_t r = 0; r < ours.rows.size(); ++r) {
    newton += ours.number(r, "newton");
    seconds += ours.number(r, "cpu_seconds");
  }
  const std::size_t last = ours.rows.size() - 1;
  return {{"scene", "gap_percent", "ccx_reached_gap_percent", "ccx_force_N", "our_force_N",
           "ccx_iterations", "our_newton", "ccx_cpu_s", "our_cpu_s", "ccx_over_ours", "ours"},
          {{theirs.scene, general(theirs.gap_percent),
            format_fixed(100 - theirs.reached * (100 - theirs.gap_percent), 1), theirs.force_N,
            ours.cell(last, "force_N"), std::to_string(theirs.iterations), general(newton),
            format_fixed(theirs.cpu_s, 2), format_fixed(seconds, 2),
            seconds > 0 ? format_fixed(theirs.cpu_s / seconds, 1) : no_value,
            ours.cell(last, "status")}}};
}

}  // namespace breast
