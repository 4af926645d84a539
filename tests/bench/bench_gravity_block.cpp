// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of a forward solve on the block other programs solved: a 0.1 m cube clamped at x = 0,
// gravity along −z, materials of one law.
//
//     bench_gravity_block [--law poly|mr] [--bulk-ratio K_OVER_MU] [--element q1p0|q2p1]
//                         [--solver direct|multigrid] [--threads T] [N...]
//
// N: elements along an edge; default 8 16 20. Law poly is (9) for fat, mr Mooney–Rivlin 310, 300
// Pa; without --bulk-ratio the block is exactly incompressible. Prints one line a size: counts,
// wall seconds by phase, processor and wall seconds in all, memory, the displacement of A =
// (100,100,100) and B = (100,50,50) mm.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

#include "bench/command_line.hpp"
#include "core/blas.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "fixtures/in_place.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"

namespace breast {
namespace {

struct Settings {
  std::string law = "poly", element = "q1p0", solver = "direct";
  double bulk_ratio = 0;
  int threads = 1;
  std::vector<int> sizes;
};

const std::vector<std::string> phases{"ordering", "assembly", "factorisation", "solve",
                                      "line search"};

MechanicsOptions one_law(const Settings& s) {
  MechanicsOptions options =
      mechanics_options({.materials = "seed2008", .element = s.element, .solver = s.solver});
  Law law = options.materials.law(Tissue::fat);
  if (s.law == "mr") law = {"mooney_rivlin", {310, 300}};
  for (Law& each : options.materials.laws) each = law;
  options.bulk_ratio = s.bulk_ratio;
  return options;
}

void print_header() {
  std::printf(
      "n\tlaw\tk_over_mu\telement\tsolver\tthreads\tunknowns\tmatrix_values\tfactor_values"
      "\tgflop\tnewton\tfactorisations\tlinear_iterations");
  for (const std::string& phase : phases) {
    std::string name = phase;
    for (char& c : name) c = c == ' ' ? '_' : c;
    std::printf("\t%s_s", name.c_str());
  }
  std::printf(
      "\tcpu_s\twall_s\tgflop_per_s\tpeak_mb\tA_x_mm\tA_y_mm\tA_z_mm\tB_x_mm"
      "\tB_y_mm\tB_z_mm\tstatus\n");
}

void print_row(const Settings& s, int n) {
  fixtures::BlockSettings block;
  block.elements = {n, n, n};
  block.order = s.element == "q2p1" ? 2 : 1;
  HexMesh mesh = fixtures::block(block);
  const MechanicsOptions options = one_law(s);
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  const SolveSummary summary = fixtures::forward_into(mesh, Vec3(0, 0, -gravity_mm_s2), options);
  const double cpu = double(std::clock() - cpu_start) / CLOCKS_PER_SEC;
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  std::printf("%d\t%s\t%g\t%s\t%s\t%d\t%lld\t%.0f\t%.0f\t%.4f\t%d\t%d\t%d", n, s.law.c_str(),
              s.bulk_ratio, s.element.c_str(), s.solver.c_str(), threads(), summary.unknowns,
              summary.matrix_values, summary.factor_values, summary.factor_gflop,
              summary.newton_iterations, summary.factorisations, summary.linear_iterations);
  const auto& seconds = summary.timer.seconds();
  for (const std::string& phase : phases) {
    const auto found = seconds.find(phase);
    std::printf("\t%.3f", found == seconds.end() ? 0.0 : found->second);
  }
  const auto factoring = seconds.find("factorisation");
  std::printf("\t%.3f\t%.3f\t%.1f\t%.0f", cpu, wall,
              factoring == seconds.end() ? 0.0
                                         : summary.factor_gflop * summary.factorisations /
                                               std::max(1e-9, factoring->second),
              peak_memory_mb());
  for (const Vec3& where : {block.size, Vec3(block.size.cwiseProduct(Vec3(1, 0.5, 0.5)))}) {
    const int node = fixtures::node_at(mesh, where);
    const Vec3 u = mesh.points[node] - mesh.reference[node];
    std::printf("\t%.4f\t%.4f\t%.4f", u.x(), u.y(), u.z());
  }
  std::printf("\t%s\n", status_name(summary.record.status));
  std::fflush(stdout);
}

Settings read(int argc, char** argv) {
  Settings s;
  s.sizes = read_command_line(
      argc, argv,
      {{"--law",
        [&](const std::string& v) {
          s.law = one_of("--law", v, {"poly", "mr"});
        }},
       {"--element",
        [&](const std::string& v) {
          s.element = one_of("--element", v, {"q1p0", "q2p1"});
        }},
       {"--solver",
        [&](const std::string& v) {
          s.solver = one_of("--solver", v, {"auto", "direct", "multigrid"});
        }},
       {"--bulk-ratio", [&](const std::string& v) { s.bulk_ratio = std::atof(v.c_str()); }},
       {"--threads", [&](const std::string& v) { s.threads = std::atoi(v.c_str()); }}},
      1, {8, 16, 20});
  return s;
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    const breast::Settings settings = breast::read(argc, argv);
    breast::set_threads(settings.threads);
    breast::prepare_blas();
    breast::print_header();
    for (const int n : settings.sizes) breast::print_row(settings, n);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_gravity_block: %s\n", error.what());
    return 1;
  }
  return 0;
}
