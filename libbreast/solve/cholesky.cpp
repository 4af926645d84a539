#include "solve/cholesky.hpp"

#include <cholmod.h>

#include <cstring>
#include <vector>

#include "core/error.hpp"
#include "solve/blas.hpp"

namespace breast {

struct Cholesky::Impl {
  cholmod_common common{};
  cholmod_sparse matrix{};
  cholmod_factor* factor = nullptr;
  cholmod_dense *solution = nullptr, *work_y = nullptr, *work_e = nullptr;
  std::vector<long> starts, rows;

  ~Impl() {
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&work_y, &common);
    cholmod_l_free_dense(&work_e, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
};

namespace {

// The graph of nodes, lower triangle without values: three times fewer vertices than unknowns.
std::vector<long> node_ordering(const NodePattern& pattern, cholmod_common& common) {
  std::vector<long> starts{0}, rows;
  for (int b = 0; b < pattern.nodes(); ++b) {
    rows.push_back(b);
    rows.insert(rows.end(), pattern.rows_begin(b), pattern.rows_begin(b) + pattern.rows_count(b));
    starts.push_back(long(rows.size()));
  }
  cholmod_sparse graph{};
  graph.nrow = graph.ncol = std::size_t(pattern.nodes());
  graph.nzmax = rows.size();
  graph.p = starts.data();
  graph.i = rows.data();
  graph.stype = -1;
  graph.itype = CHOLMOD_LONG;
  graph.xtype = CHOLMOD_PATTERN;
  graph.dtype = CHOLMOD_DOUBLE;
  graph.sorted = graph.packed = 1;
  std::vector<long> order(static_cast<std::size_t>(pattern.nodes()));
  if (cholmod_l_metis(&graph, nullptr, 0, 1, order.data(), &common) == 0) {
    throw failed_error("METIS ordering failed (CHOLMOD status ", common.status, ")");
  }
  return order;
}

cholmod_dense dense_view(Eigen::VectorXd& v) {
  cholmod_dense view{};
  view.nrow = view.nzmax = view.d = std::size_t(v.size());
  view.ncol = 1;
  view.x = v.data();
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  return view;
}

}  // namespace

Cholesky::Cholesky(const NodePattern& pattern) : impl_(std::make_unique<Impl>()) {
  cholmod_common& common = impl_->common;
  cholmod_l_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.nmethods = 1;
  common.postorder = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  prepare_blas();

  impl_->starts = pattern.column_start();
  impl_->rows = pattern.row_index();
  cholmod_sparse& matrix = impl_->matrix;
  matrix.nrow = matrix.ncol = std::size_t(pattern.unknowns());
  matrix.nzmax = impl_->rows.size();
  matrix.p = impl_->starts.data();
  matrix.i = impl_->rows.data();
  matrix.stype = -1;
  matrix.itype = CHOLMOD_LONG;
  matrix.xtype = CHOLMOD_PATTERN;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = matrix.packed = 1;

  std::vector<long> order;
  order.reserve(matrix.nrow);
  for (const long node : node_ordering(pattern, common)) {
    for (int k = 0; k < 3; ++k) order.push_back(3 * node + k);
  }
  impl_->factor = cholmod_l_analyze_p(&matrix, order.data(), nullptr, 0, &common);
  if (impl_->factor == nullptr) {
    throw failed_error("Cholesky analysis failed (CHOLMOD status ", common.status, ") for ",
                       matrix.nrow, " unknowns; out of memory?");
  }
}

Cholesky::~Cholesky() = default;

bool Cholesky::factorise(const std::vector<double>& values) {
  cholmod_common& common = impl_->common;
  impl_->matrix.xtype = CHOLMOD_REAL;
  impl_->matrix.x = const_cast<double*>(values.data());
  common.quick_return_if_not_posdef = 1;
  cholmod_l_factorize(&impl_->matrix, impl_->factor, &common);
  impl_->matrix.x = nullptr;
  if (common.status < CHOLMOD_OK) {
    throw failed_error("Cholesky factorisation failed (CHOLMOD status ", common.status,
                       "): the factor needs about ", factor_entries() * 8e-9,
                       " GB; use a coarser mesh");
  }
  return common.status == CHOLMOD_OK && impl_->factor->minor == impl_->factor->n;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& right_hand_side) const {
  Eigen::VectorXd copy = right_hand_side;
  cholmod_dense b = dense_view(copy);
  if (cholmod_l_solve2(CHOLMOD_A, impl_->factor, &b, nullptr, &impl_->solution, nullptr,
                       &impl_->work_y, &impl_->work_e, &impl_->common) == 0) {
    throw failed_error("Cholesky solve failed (CHOLMOD status ", impl_->common.status, ")");
  }
  std::memcpy(copy.data(), impl_->solution->x, sizeof(double) * std::size_t(copy.size()));
  return copy;
}

double Cholesky::factor_entries() const {
  return impl_->common.lnz;
}
double Cholesky::factor_gflop() const {
  return impl_->common.fl * 1e-9;
}

}  // namespace breast
