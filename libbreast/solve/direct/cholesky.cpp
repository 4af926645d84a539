// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct/cholesky.hpp"

#include <algorithm>
#include <atomic>
#include <new>

#include "core/blas.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "solve/direct/block_pool.hpp"
#include "solve/direct/dense.hpp"
#include "solve/direct/front_tree.hpp"

namespace breast {

namespace {
// Flops of a subtree that is worth a task of its own, and values of L that
// are worth one in a solve.
constexpr double worth_factor_task = 3e6, worth_solve_task = 2e7;
}  // namespace

class Cholesky::Impl {
 public:
  explicit Impl(const NodePattern& pattern) : tree(make_front_tree(pattern)) {
    prepare_blas();
    try {
      factor_.reset(new double[std::size_t(tree.panel_start.back())]);
    } catch (const std::bad_alloc&) {
      throw failed_error("the Cholesky factor needs ", tree.stored_entries() * 8e-9,
                         " GB, more than the available memory: use --solver multigrid or a "
                         "coarser mesh");
    }
    rest_.resize(std::size_t(tree.count()));
    for (int f = 0; f < tree.count(); ++f) {
      if (tree.parent[f] < 0) roots_.push_back(f);
    }
  }

  bool factorise(const std::vector<double>& values);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

  const FrontTree tree;

 private:
  void factor_subtree(int f, const double* values);
  void factor_front(int f, const double* values);
  void add_child(int child, int f);
  void down_subtree(int f, double* x, std::vector<double>& carried) const;
  void down_front(int f, double* x, std::vector<double>& carried) const;
  void up_subtree(int f, double* x) const;
  void up_front(int f, double* x, std::vector<double>& below) const;

  const double* panel(int f) const { return factor_.get() + tree.panel_start[f]; }
  double* panel(int f) { return factor_.get() + tree.panel_start[f]; }

  std::vector<int> roots_;
  std::unique_ptr<double[]> factor_;
  std::vector<BlockPool::Block> rest_;  // the contribution of a front to its parent
  BlockPool pool_;
  std::atomic<bool> failed_{false};
};

// Adds the lower triangle of the child's contribution to its parent's panel and rest.
void Cholesky::Impl::add_child(int child, int f) {
  const int from = tree.columns(child), size = tree.height(child) - from;
  const int* place = tree.in_parent.data() + tree.row_start[child] + from;
  const int height = tree.height(f), columns = tree.columns(f), behind = height - columns;
  const double* source = rest_[child].data.get();
  double *front = panel(f), *rest = rest_[f].data.get();
  for (int j = 0; j < size; ++j) {
    double* column = place[j] < columns ? front + long(place[j]) * height
                                        : rest + long(place[j] - columns) * behind - columns;
    const double* values = source + long(j) * size;
    for (int i = j; i < size; ++i) column[place[i]] += values[i];
  }
  pool_.give_back(std::move(rest_[child]));
  rest_[child] = {};
}

void Cholesky::Impl::factor_front(int f, const double* values) {
  const int height = tree.height(f), columns = tree.columns(f), behind = height - columns;
  double* front = panel(f);
  std::fill_n(front, std::size_t(height) * columns, 0.0);
  for (long v = tree.entry_start[f]; v < tree.entry_start[f + 1]; ++v) {
    front[tree.target[v]] += values[tree.source[v]];
  }
  if (behind > 0) {
    rest_[f] = pool_.take(std::size_t(behind) * behind);
    for (int j = 0; j < behind; ++j) {
      std::fill_n(rest_[f].data.get() + long(j) * behind + j, behind - j, 0.0);
    }
  }
  for (int k = tree.child_start[f]; k < tree.child_start[f + 1]; ++k) add_child(tree.child[k], f);
  if (!dense::eliminate(front, height, columns, rest_[f].data.get())) failed_ = true;
}

void Cholesky::Impl::factor_subtree(int f, const double* values) {
  if (tree.work[f] < worth_factor_task) {
    for (int g = tree.subtree[f]; g <= f && !failed_; ++g) factor_front(g, values);
    return;
  }
  for (int k = tree.child_start[f]; k < tree.child_start[f + 1]; ++k) {
    const int child = tree.child[k];
#pragma omp task default(none) firstprivate(child, values) if (tree.work[child] > worth_factor_task)
    factor_subtree(child, values);
  }
#pragma omp taskwait
  if (!failed_) factor_front(f, values);
}

bool Cholesky::Impl::factorise(const std::vector<double>& values) {
  failed_ = false;
  const double* data = values.data();
#pragma omp parallel num_threads(threads())
#pragma omp single
  for (const int root : roots_) factor_subtree(root, data);
  for (BlockPool::Block& block : rest_) {
    pool_.give_back(std::move(block));
    block = {};
  }
  return !failed_;
}

// In the downward sweep, a front subtracts its contribution from the later rows: it is gathered in
// `carried`, one value per row of every front, and added to the parent's.
void Cholesky::Impl::down_front(int f, double* x, std::vector<double>& carried) const {
  const int columns = tree.columns(f);
  double* own = carried.data() + tree.row_start[f];
  for (int k = tree.child_start[f]; k < tree.child_start[f + 1]; ++k) {
    const int child = tree.child[k];
    for (long r = tree.row_start[child] + tree.columns(child); r < tree.row_start[child + 1]; ++r) {
      own[tree.in_parent[r]] += carried[r];
    }
  }
  double* solved = x + tree.first_column[f];
  for (int i = 0; i < columns; ++i) solved[i] += own[i];
  dense::solve_down(panel(f), tree.height(f), columns, solved, own + columns);
}

void Cholesky::Impl::down_subtree(int f, double* x, std::vector<double>& carried) const {
  if (tree.work[f] < worth_solve_task) {
    for (int g = tree.subtree[f]; g <= f; ++g) down_front(g, x, carried);
    return;
  }
  for (int k = tree.child_start[f]; k < tree.child_start[f + 1]; ++k) {
    const int child = tree.child[k];
#pragma omp task default(none) firstprivate(child, x) \
    shared(carried) if (tree.work[child] > worth_solve_task)
    down_subtree(child, x, carried);
  }
#pragma omp taskwait
  down_front(f, x, carried);
}

void Cholesky::Impl::up_front(int f, double* x, std::vector<double>& below) const {
  const int columns = tree.columns(f), behind = tree.height(f) - columns;
  const int* rows = tree.rows.data() + tree.row_start[f] + columns;
  below.resize(std::size_t(behind));
  for (int i = 0; i < behind; ++i) below[i] = x[rows[i]];
  dense::solve_up(panel(f), tree.height(f), columns, x + tree.first_column[f], below.data());
}

void Cholesky::Impl::up_subtree(int f, double* x) const {
  std::vector<double> below;
  if (tree.work[f] < worth_solve_task) {
    for (int g = f; g >= tree.subtree[f]; --g) up_front(g, x, below);
    return;
  }
  up_front(f, x, below);
  for (int k = tree.child_start[f]; k < tree.child_start[f + 1]; ++k) {
    const int child = tree.child[k];
#pragma omp task default(none) firstprivate(child, x) if (tree.work[child] > worth_solve_task)
    up_subtree(child, x);
  }
#pragma omp taskwait
}

Eigen::VectorXd Cholesky::Impl::solve(const Eigen::VectorXd& right) const {
  const long n = right.size();
  Eigen::VectorXd x(n), out(n);
  for (long i = 0; i < n; ++i) x[i] = right[tree.order[i]];
  std::vector<double> carried(tree.rows.size(), 0.0);
#pragma omp parallel num_threads(threads())
#pragma omp single
  for (const int root : roots_) {
    down_subtree(root, x.data(), carried);
    up_subtree(root, x.data());
  }
  for (long i = 0; i < n; ++i) out[tree.order[i]] = x[i];
  return out;
}

Cholesky::Cholesky(const NodePattern& pattern) : impl_(std::make_unique<Impl>(pattern)) {}
Cholesky::~Cholesky() = default;

bool Cholesky::factorise(const std::vector<double>& values) {
  return impl_->factorise(values);
}
Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& right_hand_side) const {
  return impl_->solve(right_hand_side);
}
double Cholesky::factor_entries() const {
  return impl_->tree.stored_entries();
}
double Cholesky::factor_gflop() const {
  return impl_->tree.flops() * 1e-9;
}

}  // namespace breast
