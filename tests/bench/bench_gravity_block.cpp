// Time of a forward solve on the block other programs solved: a 0.1 m cube of fat, law (9), clamped
// at x = 0, gravity along −z, exactly incompressible.
//
//     bench_gravity_block [N...]        elements along an edge; default 8 16
//
// Prints one row per N. u_* is the displacement of the corner (100, 100, 100) mm.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "solve/blas.hpp"
#include "solve/cholesky.hpp"

namespace breast {
namespace {

const std::vector<std::string> phases{"ordering", "assembly", "factorisation", "solve",
                                      "line search"};

MechanicsOptions fat_only() {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  const Law fat = options.materials.law(Tissue::fat);
  for (Law& law : options.materials.laws) law = fat;
  return options;
}

void print_header() {
  std::printf("n\tthreads\tunknowns\tfactor_entries\tfactor_gflop\tnewton\tfactorisations");
  for (const std::string& phase : phases) {
    std::string name = phase;
    for (char& c : name) c = c == ' ' ? '_' : c;
    std::printf("\t%s_s", name.c_str());
  }
  std::printf("\ttotal_s\tu_x_mm\tu_y_mm\tu_z_mm\tstatus\n");
}

void print_row(int n) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  HexMesh mesh = fixtures::block(settings);
  const MechanicsOptions options = fat_only();
  const Scene scene(mesh, options);
  const Cholesky factor(*scene.assembly().pattern());  // analysis only: the solve makes its own

  const auto start = std::chrono::steady_clock::now();
  const SolveSummary summary = solve_forward(mesh, Vec3(0, 0, -gravity_mm_s2), options);
  const double total =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  std::printf("%d\t%d\t%ld\t%.0f\t%.3f\t%d\t%d", n, threads(), scene.unknowns(),
              factor.factor_entries(), factor.factor_gflop(), summary.newton_iterations,
              summary.factorisations);
  const auto& seconds = summary.timer.seconds();
  for (const std::string& phase : phases) {
    const auto found = seconds.find(phase);
    std::printf("\t%.3f", found == seconds.end() ? 0.0 : found->second);
  }
  const int corner = fixtures::node_at(mesh, settings.size);
  const Vec3 u = mesh.points[corner] - mesh.reference[corner];
  std::printf("\t%.3f\t%.4f\t%.4f\t%.4f\t%s\n", total, u.x(), u.y(), u.z(),
              summary.record.status.c_str());
  std::fflush(stdout);
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    char* end = nullptr;
    const long n = std::strtol(argv[i], &end, 10);
    if (*end != '\0' || n < 1 || n > 64) {
      std::fprintf(stderr, "bench_gravity_block: '%s' is no number of elements from 1 to 64\n",
                   argv[i]);
      return 2;
    }
    sizes.push_back(int(n));
  }
  if (sizes.empty()) sizes = {8, 16};
  try {
    breast::set_threads(0);
    breast::prepare_blas();
    breast::print_header();
    for (const int n : sizes) breast::print_row(n);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_gravity_block: %s\n", error.what());
    return 1;
  }
  return 0;
}
