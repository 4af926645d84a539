// Compression of the block other programs compressed: a 0.1 m cube of fat, law (9), clamped at
// x = 0, between frictionless plates.
//
//     bench_pressed_block [--bulk-ratio K_OVER_MU] [--from GAP] [--to GAP] [--quarter]
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

#include "core/blas.hpp"
#include "core/parallel.hpp"
#include "core/report.hpp"
#include "fixtures/pressed_block.hpp"

namespace {

using breast::fixtures::PressedBlock;
using clock_type = std::chrono::steady_clock;

void press(int n, double bulk_ratio, int first_gap, int last_gap, PressedBlock::Part part,
           double clear) {
  PressedBlock block(n, bulk_ratio, part, clear);
  for (int gap = first_gap; gap >= last_gap; gap -= 10) {
    const int before = block.factorisations();
    const auto start = clock_type::now();
    const double cpu = breast::cpu_seconds();
    const breast::PathResult path = block.close_to(gap / 100.0);
    const double seconds = std::chrono::duration<double>(clock_type::now() - start).count();
    const breast::Vec3 u = block.corner();
    std::printf("%d\t%d\t%g\t%d\t%.1f\t%.4f\t%.4f\t%.4f\t%d\t%d\t%d\t%d\t%.2e\t%.2f\t%.2f\t%s\n", n,
                breast::threads(), bulk_ratio, gap, block.force(path), u.x(), u.y(), u.z(),
                path.iterations, path.failures, block.factorisations() - before, path.indefinite,
                path.final_step.forces.max_volume_error, seconds, breast::cpu_seconds() - cpu,
                path.reached ? "reached" : describe(path.last_failure).c_str());
    std::fflush(stdout);
    if (!path.reached) return;
  }
}

int number(const std::string& text, int low, int high) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || value < low || value > high) {
    std::fprintf(stderr, "bench_pressed_block: '%s' is no number from %d to %d\n", text.c_str(),
                 low, high);
    std::exit(2);
  }
  return int(value);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  double bulk_ratio = 0;
  int first_gap = 70, last_gap = 30;
  PressedBlock::Part part = PressedBlock::Part::whole;
  double clear = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--bulk-ratio" && i + 1 < argc) {
      bulk_ratio = number(argv[++i], 1, 1000000000);
    } else if (option == "--from" && i + 1 < argc) {
      first_gap = number(argv[++i], 10, 90);
    } else if (option == "--to" && i + 1 < argc) {
      last_gap = number(argv[++i], 10, 70);
    } else if (option == "--clear" && i + 1 < argc) {
      clear = number(argv[++i], 1, 90);
    } else if (option == "--quarter") {
      part = PressedBlock::Part::quarter;
    } else {
      sizes.push_back(number(option, 2, 64));
    }
  }
  if (sizes.empty()) sizes = {8};
  try {
    breast::set_threads(0);
    breast::prepare_blas();
    std::printf(
        "n\tthreads\tbulk_ratio\tgap_percent\tforce_N\tu_x_mm\tu_y_mm\tu_z_mm\tnewton\t"
        "failed_steps\tfactorisations\tindefinite\tvolume_error\tseconds\tcpu_seconds\tstatus\n");
    for (const int n : sizes) press(n, bulk_ratio, first_gap, last_gap, part, clear);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_pressed_block: %s\n", error.what());
    return 1;
  }
  return 0;
}
