// SPDX-License-Identifier: GPL-3.0-or-later
// Compression of the block other programs compressed: a 0.1 m cube of fat, law (9), clamped at
// x = 0, between frictionless plates.
//
//     bench_pressed_block [--bulk-ratio K_OVER_MU] [--from GAP] [--to GAP] [--part whole|quarter]
//         [--clear MM] [N...]
//
// N: elements along an edge (default 8); without a bulk ratio exactly incompressible. The plates
// keep one element, or --clear, from the clamp. Prints one row per N and gap (70, 60, ... % of the
// height, the first --from, the last --to): paddle force and the displacement of the corner (100,
// 100, 100) mm. Seconds and iterations are those since the last row.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "bench/command_line.hpp"
#include "core/blas.hpp"
#include "core/parallel.hpp"
#include "core/report.hpp"
#include "fixtures/pressed_block.hpp"

namespace {

using breast::fixtures::PressedBlock;
using clock_type = std::chrono::steady_clock;

struct Settings {
  std::vector<int> sizes;
  double bulk_ratio = 0, clear = 0;
  int first_gap = 70, last_gap = 30;
  PressedBlock::Part part = PressedBlock::Part::whole;
};

// The number, where it is from `low` to `high`.
double number(const char* option, const std::string& text, double low, double high) {
  const double value = std::atof(text.c_str());
  if (value >= low && value <= high) return value;
  throw breast::input_error(option, " '", text, "' is no number from ", low, " to ", high);
}

Settings read(int argc, char** argv) {
  Settings s;
  using Text = const std::string&;
  s.sizes = breast::read_command_line(
      argc, argv,
      {{"--bulk-ratio", [&](Text v) { s.bulk_ratio = number("--bulk-ratio", v, 1, 1e9); }},
       {"--from", [&](Text v) { s.first_gap = int(number("--from", v, 10, 90)); }},
       {"--to", [&](Text v) { s.last_gap = int(number("--to", v, 10, 70)); }},
       {"--clear", [&](Text v) { s.clear = number("--clear", v, 1, 90); }},
       {"--part",
        [&](Text v) {
          s.part = breast::one_of("--part", v, {"whole", "quarter"}) == "whole"
                       ? PressedBlock::Part::whole
                       : PressedBlock::Part::quarter;
        }}},
      2, {8});
  return s;
}

void press(int n, const Settings& s) {
  PressedBlock block(n, s.bulk_ratio, s.part, s.clear);
  for (int gap = s.first_gap; gap >= s.last_gap; gap -= 10) {
    const int before = block.factorisations();
    const auto start = clock_type::now();
    const double cpu = breast::cpu_seconds();
    const breast::PathResult path = block.close_to(gap / 100.0);
    const double seconds = std::chrono::duration<double>(clock_type::now() - start).count();
    const breast::Vec3 u = block.corner();
    std::printf("%d\t%d\t%g\t%d\t%.1f\t%.4f\t%.4f\t%.4f\t%d\t%d\t%d\t%d\t%.2e\t%.2f\t%.2f\t%s\n", n,
                breast::threads(), s.bulk_ratio, gap, block.force(path), u.x(), u.y(), u.z(),
                path.iterations, path.failures, block.factorisations() - before, path.indefinite,
                path.final_step.forces.max_volume_error, seconds, breast::cpu_seconds() - cpu,
                path.reached() ? "reached" : describe(path.last_failure));
    std::fflush(stdout);
    if (!path.reached()) return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Settings s = read(argc, argv);
    breast::set_threads(0);
    breast::prepare_blas();
    std::printf(
        "n\tthreads\tbulk_ratio\tgap_percent\tforce_N\tu_x_mm\tu_y_mm\tu_z_mm\tnewton\t"
        "failed_steps\tfactorisations\tindefinite\tvolume_error\tseconds\tcpu_seconds\tstatus\n");
    for (const int n : s.sizes) press(n, s);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_pressed_block: %s\n", error.what());
    return 1;
  }
  return 0;
}
