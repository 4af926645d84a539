// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the table of extreme cases of gravity as TSV, a row for each direction of each case:
//
//     print_extreme_mechanics [--limit ELEMENTS] [NAME]    cases of at most so many elements
//
// whose name contains NAME. "residual" is relative to the load, seconds are wall time.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "core/blas.hpp"
#include "core/parallel.hpp"
#include "extreme/table/cases.hpp"
#include "mechanics/scene.hpp"

namespace breast::extreme {
namespace {

void print(const Case& each) {
  const Problem problem = each.make();
  for (const Row& row : solve(problem)) {
    const SolveSummary& s = row.summary;
    std::printf("%s\t%d\t%lld\t%s\t%d\t%d\t%.1e\t%.3f\t%.2f\t", each.name.c_str(),
                problem.mesh.elements(), s.unknowns, row.direction.c_str(), s.steps,
                s.newton_iterations, s.residual, s.min_det_F, row.seconds);
    if (row.direction == "forward" && s.converged()) {
      std::printf("%.1e", row.closure_mm);
    } else {
      std::printf("-");
    }
    std::printf("\t%s\t%s\n", row.outcome().c_str(), s.record.reason.c_str());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace breast::extreme

int main(int argc, char** argv) {
  long limit = 20000;
  std::string name;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--limit") == 0 && i + 1 < argc) {
      limit = std::strtol(argv[++i], nullptr, 10);
    } else {
      name = argv[i];
    }
  }
  try {
    breast::set_threads(0);
    breast::prepare_blas();
    std::printf(
        "case\telements\tunknowns\tdirection\tsteps\tnewton\tresidual\tmin_det_F\tseconds\t"
        "closure_mm\toutcome\treason\n");
    for (const breast::extreme::Case& each : breast::extreme::cases()) {
      if (each.elements <= limit && each.name.find(name) != std::string::npos) {
        breast::extreme::print(each);
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "print_extreme_mechanics: %s\n", error.what());
    return 1;
  }
  return 0;
}
