// SPDX-License-Identifier: GPL-3.0-or-later
// How the multigrid solver grows with the mesh: one linear system of equilibrium under gravity, at
// rest, exactly incompressible, to a relative residual of 1e-6.
//
//     bench_multigrid [--body block|dome] [--element q1p0|q2p1] [--distortion D] [--threads T]
//     [N...]
//
// N: elements along an edge, ascending; default 24 48. The block is a 0.1 m cube of fat, law (9),
// inner nodes moved by D of an element; the dome an analytic breast of about N³ elements with
// gland and 1.45 mm membrane skin. Prints a line a size: elements, unknowns (held displacements
// and pressures included), processor seconds of building the levels and of the solve, GMRES
// iterations, peak memory of the process in MB, and the residual as multiplied out. From the second
// size on the last two columns are growths since the first: the exponent of seconds in unknowns,
// and the factor of iterations per 8 times the unknowns.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "bench/command_line.hpp"
#include "core/blas.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/report.hpp"
#include "core/units.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/block.hpp"
#include "mechanics/scene.hpp"
#include "mesh/element_order.hpp"

namespace breast {
namespace {

struct Settings {
  std::string body = "block", element = "q1p0";
  double distortion = 0;
  int threads = 1;
  std::vector<int> sizes;
};

struct Row {
  double elements = 0, unknowns = 0, set_up = 0, solve = 0, iterations = 0, memory = 0;
  double residual = 0;
};

HexMesh body(const Settings& s, int n) {
  const int order = s.element == "q2p1" ? 2 : 1;
  if (s.body == "dome") {
    const HexMesh dome = analytic_breast_mesh(n);
    return order == 2 ? raise_order(dome) : dome;
  }
  fixtures::BlockSettings block;
  block.elements = {n, n, n};
  block.distortion = s.distortion;
  block.order = order;
  return fixtures::block(block);
}

// Of both equations, in the norm the solver uses: volumes as forces, θκ/h.
double residual(const SaddleMatrix& matrix, const Constraints& held, const Forces& forces,
                const SaddleStep& step) {
  const double weigh = matrix.kappa.mean() / std::cbrt(matrix.space->mass[0]);
  const auto size = [&](Eigen::VectorXd force, const Eigen::VectorXd& volume) {
    held.project(force);
    return std::hypot(force.norm(), weigh * volume.norm());
  };
  return size(matrix.multiply_unaugmented(step.u) - matrix.divergence.apply_transpose(step.p) +
                  forces.r,
              matrix.divergence.apply(step.u) + forces.theta) /
         size(forces.r, forces.theta);
}

Row measure(const Settings& s, int n) {
  const HexMesh mesh = body(s, n);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.solver = SolverOption::multigrid;
  options.element = s.element == "q2p1" ? Element::q2p1 : Element::q1p0;
  const Scene scene(mesh, options);
  const Eigen::VectorXd rest = flatten(mesh.reference.empty() ? mesh.points : mesh.reference);
  const Problem problem = scene.problem(scene.gravity_force(Vec3(0, 0, -gravity_mm_s2))).problem;
  SaddleMatrix matrix = problem.make_matrix();
  Forces forces;
  if (!problem.tangent(scene.at_rest(rest), forces, matrix)) {
    throw failed_error("element ", forces.bad_element, " is folded at rest");
  }
  SaddleSolver solver(problem.space().pattern, scene.solid().solver());
  const double start = cpu_seconds();
  if (!solver.factorise(matrix, scene.walls(), false).ok) {
    throw failed_error("the stiffness at rest is not positive definite");
  }
  const double built = cpu_seconds();
  const SaddleStep step = solver.solve(matrix, forces.r, forces.theta, 1e-5);
  return {double(mesh.elements()),
          double(forces.r.size() + forces.theta.size()),
          built - start,
          cpu_seconds() - built,
          double(step.iterations),
          peak_memory_mb(),
          residual(matrix, scene.walls(), forces, step)};
}

void print_row(int n, const Row& row, const Row& first) {
  std::printf("%d\t%.0f\t%.0f\t%.3f\t%.3f\t%.0f\t%.0f\t%.1e", n, row.elements, row.unknowns,
              row.set_up, row.solve, row.iterations, row.memory, row.residual);
  const double larger = std::log(row.unknowns / first.unknowns);
  if (larger > 0) {
    const double longer = std::log((row.set_up + row.solve) / (first.set_up + first.solve));
    std::printf("\t%.2f\t%.2f", longer / larger,
                std::pow(row.iterations / first.iterations, std::log(8.0) / larger));
  }
  std::printf("\n");
  std::fflush(stdout);
}

Settings read(int argc, char** argv) {
  Settings s;
  s.sizes = read_command_line(
      argc, argv,
      {{"--body",
        [&](const std::string& v) {
          s.body = one_of("--body", v, {"block", "dome"});
        }},
       {"--element",
        [&](const std::string& v) {
          s.element = one_of("--element", v, {"q1p0", "q2p1"});
        }},
       {"--distortion", [&](const std::string& v) { s.distortion = std::atof(v.c_str()); }},
       {"--threads", [&](const std::string& v) { s.threads = std::atoi(v.c_str()); }}},
      2, {24, 48});
  return s;
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    const breast::Settings settings = breast::read(argc, argv);
    breast::set_threads(settings.threads);
    breast::prepare_blas();
    std::printf(
        "n\telements\tunknowns\tset_up_cpu_s\tsolve_cpu_s\titerations\tpeak_mb\tresidual"
        "\ttime_exponent\titeration_growth\n");
    breast::Row first;
    for (const int n : settings.sizes) {
      const breast::Row row = breast::measure(settings, n);
      if (first.unknowns == 0) first = row;
      breast::print_row(n, row, first);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_multigrid: %s\n", error.what());
    return 1;
  }
  return 0;
}
