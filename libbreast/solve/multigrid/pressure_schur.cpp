// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/multigrid/pressure_schur.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "solve/krylov/conjugate_gradients.hpp"

namespace breast {

namespace {

// The elements at every node, and which of their nodes it is.
using Corners = std::vector<std::vector<std::pair<int, int>>>;
Corners corners_at_nodes(const Cells& cells, int nodes) {
  Corners at(static_cast<std::size_t>(nodes));
  for (int e = 0; e < cells.count(); ++e) {
    for (int a = 0; a < cells.nodes_per_cell; ++a) at[cells.cell(e)[a]].emplace_back(e, a);
  }
  return at;
}

// Inverse diagonal blocks in global axes, zero along constrained components; empty if one of them
// is not positive definite.
std::vector<Mat3> flexibilities(const NodeMatrix& imposed, const Constraints& constraints) {
  std::vector<Mat3> out;
  for (int node = 0; node < imposed.pattern().nodes(); ++node) {
    const Eigen::LLT<Mat3> factor(imposed.block(node, -1));
    if (factor.info() != Eigen::Success) return {};
    Mat3 inverse = factor.solve(Mat3::Identity());
    if (const NodeConstraint* c = constraints.at(node)) {
      for (int k = 0; k < 3; ++k) {
        if (c->held[k]) inverse(k, k) = 0;  // held rows couple with nothing
      }
      inverse = c->axes * inverse * c->axes.transpose();
    }
    out.push_back(inverse);
  }
  return out;
}

// The sparse approximation of B K⁻¹ Bᵀ + cM for one pressure per element.
BlockMatrix<1, 1> node_sum(const SaddleMatrix& matrix, const std::vector<Mat3>& flexibility) {
  const ElementRows& b = matrix.divergence;
  const Cells& cells = *b.cells;
  const Corners corners = corners_at_nodes(cells, int(flexibility.size()));
  const auto part = [&](int e) { return matrix.space->mass_at(e)(0, 0) / cells.nodes_per_cell; };
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(long(flexibility.size()));
  for (int e = 0; e < cells.count(); ++e) {
    for (int a = 0; a < cells.nodes_per_cell; ++a) {
      stiffness[cells.cell(e)[a]] += matrix.shear[e] * part(e);
    }
  }
  BlockMatrix<1, 1> out;
  out.rows = out.columns = cells.count();
  RowSum<1, 1> row(out.columns);
  for (int e = 0; e < cells.count(); ++e) {
    row.at(e)(0) += matrix.space->compliance[e] * matrix.space->mass_at(e)(0, 0);
    for (int a = 0; a < cells.nodes_per_cell; ++a) {
      const int node = cells.cell(e)[a];
      const Vec3 moved =
          schur_gradient_weight * (flexibility[node] * b.at(e).middleCols<3>(3L * a).transpose());
      const double smooth = part(e) / stiffness[node];
      for (const auto& [f, c] : corners[node]) {
        row.at(f)(0) += b.at(f).middleCols<3>(3L * c).row(0).dot(moved) + smooth * part(f);
      }
    }
    row.flush(out);
  }
  return out;
}

}  // namespace

bool PressureSchur::build(const SaddleMatrix& matrix, const NodeMatrix& imposed,
                          const Constraints& constraints) {
  space_ = matrix.space;
  kappa_ = matrix.kappa;
  shear_ = matrix.shear;
  left_over_ = 1 - kappa_[0] * space_->compliance[0];
  sparse_ = {};
  if (space_->rows > 1 || left_over_ < schur_nothing_left) return true;
  const std::vector<Mat3> flexibility = flexibilities(imposed, constraints);
  if (flexibility.empty()) return false;
  sparse_ = node_sum(matrix, flexibility);
  reciprocal_ = sparse_.diagonal().cwiseInverse();
  return true;
}

Eigen::VectorXd PressureSchur::solve_sparse(const Eigen::VectorXd& q) const {
  const auto apply = [&](const Eigen::VectorXd& v) {
    Eigen::VectorXd out;
    sparse_.multiply(v, out);
    return out;
  };
  const auto scale = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return reciprocal_.cwiseProduct(v);
  };
  const int steps = int(schur_steps_per_edge * std::cbrt(double(sparse_.rows)));
  return conjugate_gradients(apply, scale, q,
                             {schur_accuracy, 0, std::max(schur_least_steps, steps)})
      .x;
}

Eigen::VectorXd PressureSchur::solve(const Eigen::VectorXd& q) const {
  Eigen::VectorXd p = space_->divide(q, kappa_);
  if (left_over_ < schur_nothing_left) return p;
  if (sparse_.rows > 0) return p + left_over_ * solve_sparse(q);
  const Eigen::VectorXd softness = shear_.cwiseInverse() + space_->compliance;
  return p + left_over_ * space_->divide(q, softness.cwiseInverse());
}

}  // namespace breast
