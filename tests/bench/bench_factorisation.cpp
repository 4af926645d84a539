// SPDX-License-Identifier: GPL-3.0-or-later
// Our multifrontal Cholesky beside CHOLMOD's supernodal one: the same matrix (gravity block at
// rest, law of fat, κ/μ = 1000), the same ordering (METIS on the nodes), turn about in one process.
//
//     bench_factorisation [--threads T] [N...]
//
// Prints, a line a size and program: values of L, GFlop, processor and wall seconds of one
// factorisation (the least of `turns`) and of one solve, GFlop per processor second, and the
// difference of the solutions.
#include <cholmod.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <functional>
#include <vector>

#include "core/blas.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "mechanics/scene.hpp"
#include "solve/direct/cholesky.hpp"

extern "C" void openblas_set_num_threads(int);

namespace breast {
namespace {

constexpr int turns = 3;

// CHOLMOD with an ordering of METIS on the nodes' graph, as ours has it.
class Cholmod {
 public:
  explicit Cholmod(const NodePattern& pattern)
      : starts_(pattern.column_start()),
        rows_(pattern.row_index().begin(), pattern.row_index().end()) {
    cholmod_l_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = 1;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    std::vector<long> first{0}, below;
    for (int b = 0; b < pattern.nodes(); ++b) {
      below.push_back(b);
      below.insert(below.end(), pattern.rows_begin(b),
                   pattern.rows_begin(b) + pattern.rows_count(b));
      first.push_back(long(below.size()));
    }
    cholmod_sparse graph = sparse(std::size_t(pattern.nodes()), first, below, nullptr);
    std::vector<long> nodes(std::size_t(pattern.nodes())), order;
    cholmod_l_metis(&graph, nullptr, 0, 1, nodes.data(), &common_);
    for (const long node : nodes) {
      for (int k = 0; k < 3; ++k) order.push_back(3 * node + k);
    }
    cholmod_sparse a = sparse(std::size_t(pattern.unknowns()), starts_, rows_, nullptr);
    factor_ = cholmod_l_analyze_p(&a, order.data(), nullptr, 0, &common_);
    if (factor_ == nullptr) throw failed_error("CHOLMOD analysis failed");
  }
  ~Cholmod() {
    cholmod_l_free_factor(&factor_, &common_);
    cholmod_l_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  bool factorise(std::vector<double>& values) {
    cholmod_sparse a = sparse(factor_->n, starts_, rows_, values.data());
    cholmod_l_factorize(&a, factor_, &common_);
    return common_.status == CHOLMOD_OK;
  }
  Eigen::VectorXd solve(Eigen::VectorXd b) {
    cholmod_dense right{};
    right.nrow = right.nzmax = right.d = std::size_t(b.size());
    right.ncol = 1;
    right.x = b.data();
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_l_solve(CHOLMOD_A, factor_, &right, &common_);
    b = Eigen::Map<Eigen::VectorXd>(static_cast<double*>(x->x), b.size());
    cholmod_l_free_dense(&x, &common_);
    return b;
  }
  double entries() const { return double(factor_->xsize); }
  double gflop() const { return common_.fl * 1e-9; }

 private:
  static cholmod_sparse sparse(std::size_t n, std::vector<long>& starts, std::vector<long>& rows,
                               double* values) {
    cholmod_sparse a{};
    a.nrow = a.ncol = n;
    a.nzmax = rows.size();
    a.p = starts.data();
    a.i = rows.data();
    a.x = values;
    a.stype = -1;
    a.itype = CHOLMOD_LONG;
    a.xtype = values != nullptr ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    return a;
  }
  std::vector<long> starts_, rows_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

struct Seconds {
  double cpu = 1e300, wall = 1e300;
  void least(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t before = std::clock();
    work();
    cpu = std::min(cpu, double(std::clock() - before) / CLOCKS_PER_SEC);
    wall = std::min(
        wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
};

void print(int n, const char* program, double entries, double gflop, const Seconds& factor,
           const Seconds& solve, double difference) {
  std::printf("%d\t%s\t%d\t%.0f\t%.3f\t%.4f\t%.4f\t%.1f\t%.4f\t%.1e\n", n, program, threads(),
              entries, gflop, factor.cpu, factor.wall, gflop / factor.cpu, solve.cpu, difference);
  std::fflush(stdout);
}

void compare(int n) {
  fixtures::BlockSettings block;
  block.elements = {n, n, n};
  const HexMesh mesh = fixtures::block(block);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.solver = SolverOption::direct;
  const Scene scene(mesh, options);
  const Problem problem = scene.problem(scene.gravity_force(Vec3(0, 0, -gravity_mm_s2))).problem;
  SaddleMatrix matrix = problem.make_matrix();
  Forces forces;
  problem.tangent(scene.at_rest(flatten(mesh.reference)), forces, matrix);
  // Held nodes by a large diagonal: a positive definite matrix is all that is wanted.
  for (int node = 0; node < scene.nodes(); ++node) {
    if (scene.walls().at(node) != nullptr) {
      matrix.stiffness.add_to_node(node, 1e9 * Mat3::Identity());
    }
  }
  std::vector<double> values = matrix.stiffness.values();
  const Eigen::VectorXd right = scene.gravity_force(Vec3(0, 0, -gravity_mm_s2));
  Cholesky ours(matrix.stiffness.pattern());
  Cholmod theirs(matrix.stiffness.pattern());
  Seconds factor[2], solve[2];
  Eigen::VectorXd x, y;
  for (int i = 0; i < turns; ++i) {
    openblas_set_num_threads(1);
    factor[0].least([&] {
      if (!ours.factorise(values)) throw failed_error("our factorisation failed");
    });
    solve[0].least([&] { x = ours.solve(right); });
    openblas_set_num_threads(threads());
    factor[1].least([&] {
      if (!theirs.factorise(values)) throw failed_error("CHOLMOD's factorisation failed");
    });
    solve[1].least([&] { y = theirs.solve(right); });
  }
  print(n, "ours", ours.factor_entries(), ours.factor_gflop(), factor[0], solve[0], 0);
  print(n, "CHOLMOD", theirs.entries(), theirs.gflop(), factor[1], solve[1],
        (x - y).norm() / y.norm());
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    int threads = 1;
    std::vector<int> sizes;
    for (int i = 1; i < argc; ++i) {
      if (std::strcmp(argv[i], "--threads") == 0 && i + 1 < argc) {
        threads = std::atoi(argv[++i]);
      } else if (std::atoi(argv[i]) > 0) {
        sizes.push_back(std::atoi(argv[i]));
      } else {
        throw breast::input_error("'", argv[i], "' is not a number of elements along an edge");
      }
    }
    breast::set_threads(threads);
    breast::prepare_blas();
    std::printf(
        "n\tprogram\tthreads\tvalues_of_L\tgflop\tfactor_cpu_s\tfactor_wall_s\tgflop_per_cpu_s"
        "\tsolve_cpu_s\tdifference\n");
    for (const int n : sizes.empty() ? std::vector<int>{8, 16, 20} : sizes) breast::compare(n);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_factorisation: %s\n", error.what());
    return 1;
  }
  return 0;
}
