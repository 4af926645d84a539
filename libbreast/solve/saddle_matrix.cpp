// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/saddle_matrix.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace breast {

void ElementRows::resize(const Cells& over, int rows_per_element) {
  cells = &over;
  rows = rows_per_element;
  values.assign(std::size_t(over.count()) * rows * 3 * over.nodes_per_cell, 0.0);
}

Eigen::Map<const Eigen::MatrixXd> ElementRows::at(int e) const {
  const int columns = 3 * cells->nodes_per_cell;
  return {values.data() + std::size_t(e) * rows * columns, rows, columns};
}
Eigen::Map<Eigen::MatrixXd> ElementRows::at(int e) {
  const int columns = 3 * cells->nodes_per_cell;
  return {values.data() + std::size_t(e) * rows * columns, rows, columns};
}

Eigen::VectorXd ElementRows::apply(const Eigen::VectorXd& u) const {
  Eigen::VectorXd out(long(rows) * cells->count());
#pragma omp parallel for num_threads(threads()) schedule(static) if (cells->count() > worth_threads)
  for (int e = 0; e < cells->count(); ++e) {
    out.segment(long(e) * rows, rows).noalias() = at(e) * cells->gather(e, u);
  }
  return out;
}

Eigen::VectorXd ElementRows::apply_transpose(const Eigen::VectorXd& p) const {
  int nodes = 0;
  for (const int node : cells->nodes) nodes = std::max(nodes, node + 1);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3L * nodes);
  const int n = cells->nodes_per_cell;
  Eigen::VectorXd local(3L * n);
  for (int e = 0; e < cells->count(); ++e) {
    local.noalias() = at(e).transpose() * p.segment(long(e) * rows, rows);
    for (int a = 0; a < n; ++a) out.segment<3>(3L * cells->cell(e)[a]) += local.segment<3>(3L * a);
  }
  return out;
}

Eigen::Map<const Eigen::MatrixXd> PressureSpace::mass_at(int e) const {
  return {mass.data() + std::size_t(e) * rows * rows, rows, rows};
}
Eigen::Map<const Eigen::MatrixXd> PressureSpace::inverse_at(int e) const {
  return {inverse_mass.data() + std::size_t(e) * rows * rows, rows, rows};
}

Eigen::VectorXd PressureSpace::multiply(const Eigen::VectorXd& q,
                                        const Eigen::VectorXd& factor) const {
  Eigen::VectorXd out(q.size());
  for (int e = 0; e < elements(); ++e) {
    out.segment(long(e) * rows, rows).noalias() =
        factor[e] * (mass_at(e) * q.segment(long(e) * rows, rows));
  }
  return out;
}

Eigen::VectorXd PressureSpace::divide(const Eigen::VectorXd& q,
                                      const Eigen::VectorXd& factor) const {
  Eigen::VectorXd out(q.size());
  for (int e = 0; e < elements(); ++e) {
    out.segment(long(e) * rows, rows).noalias() =
        factor[e] * (inverse_at(e) * q.segment(long(e) * rows, rows));
  }
  return out;
}

Eigen::VectorXd SaddleMatrix::multiply_unaugmented(const Eigen::VectorXd& u) const {
  return stiffness.multiply(u) -
         divergence.apply_transpose(space->divide(divergence.apply(u), kappa));
}

}  // namespace breast
