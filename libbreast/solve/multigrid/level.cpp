// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "solve/krylov/lanczos.hpp"
#include "solve/multigrid/impl.hpp"
#include "solve/multigrid/settings.hpp"

namespace breast {

template <int B>
bool MultigridLevel<B>::prepare() {
  inverse_diagonal = a.diagonal().cwiseInverse();
  if (!(inverse_diagonal.minCoeff() > 0) || !inverse_diagonal.allFinite()) return false;
  // D^−1/2 A D^−1/2 has the eigenvalues of D⁻¹A. A start that is no eigenvector of anything, the
  // same every time.
  const Eigen::VectorXd root = inverse_diagonal.cwiseSqrt();
  Eigen::VectorXd start(root.size());
  for (long i = 0; i < start.size(); ++i) start[i] = std::sin(1.0 + 7.3 * double(i));
  const auto scaled = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    Eigen::VectorXd ax;
    a.multiply(root.cwiseProduct(x), ax);
    return root.cwiseProduct(ax);
  };
  largest = largest_eigenvalue(scaled, start, spectrum_steps);
  return std::isfinite(largest);
}

template <int B>
void MultigridLevel<B>::smooth(const Eigen::VectorXd& right, Eigen::VectorXd& x) const {
  const double upper = largest, lower = smoothed_from * largest;
  const double centre = 0.5 * (upper + lower), half = 0.5 * (upper - lower);
  const double sigma = centre / half;
  double rho = 1 / sigma;
  Eigen::VectorXd residual, step;
  if (x.size() == 0) {
    residual = right;
    x = Eigen::VectorXd::Zero(right.size());
  } else {
    a.multiply(x, residual);
    residual = right - residual;
  }
  step = inverse_diagonal.cwiseProduct(residual) / centre;
  x += step;
  for (int i = 1; i < smoother_degree; ++i) {
    a.multiply(x, residual);
    residual = right - residual;
    const double next = 1 / (2 * sigma - rho);
    step = next * rho * step + (2 * next / half) * inverse_diagonal.cwiseProduct(residual);
    x += step;
    rho = next;
  }
}

template <int B>
Motions<6> MultigridLevel<B>::coarsen(const Motions<B>& motions, double threshold) {
  const Aggregates aggregates = aggregate(strong_couplings<B>(a, threshold));
  std::vector<std::vector<int>> members(std::size_t(aggregates.count));
  for (int i = 0; i < a.rows; ++i) {
    if (aggregates.of[i] >= 0) members[aggregates.of[i]].push_back(i);
  }
  // Orthonormal motions of every aggregate by Gram–Schmidt: Q interpolates, R is the next level's.
  Motions<B> tentative(std::size_t(a.rows), Eigen::Matrix<double, B, 6>::Zero());
  Motions<6> coarse;
  for (const std::vector<int>& nodes : members) {
    Eigen::MatrixXd q(Eigen::Index{B} * Eigen::Index(nodes.size()), 6);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      q.middleRows<B>(long(B) * long(k)) = motions[nodes[k]];
    }
    Eigen::Matrix<double, 6, 6> r = Eigen::Matrix<double, 6, 6>::Zero();
    for (int c = 0; c < 6; ++c) {
      const double before = q.col(c).norm();
      for (int repeat = 0; repeat < 2; ++repeat) {
        for (int d = 0; d < c; ++d) {
          const double along = q.col(d).dot(q.col(c));
          r(d, c) += along;
          q.col(c) -= along * q.col(d);
        }
      }
      const double length = q.col(c).norm();
      const bool independent = length > 1e-8 * before && before > 0;
      r(c, c) = independent ? length : 0;
      if (independent) {
        q.col(c) /= length;
      } else {
        q.col(c).setZero();
      }
    }
    coarse.push_back(r);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      tentative[nodes[k]] = q.middleRows<B>(long(B) * long(k));
    }
  }
  interpolation.rows = a.rows;
  interpolation.columns = aggregates.count;
  RowSum<B, 6> row(aggregates.count);
  const double weight = 4.0 / 3 / largest;
  for (int i = 0; i < a.rows; ++i) {
    if (aggregates.of[i] >= 0) row.at(aggregates.of[i]) += tentative[i];
    const auto scale = -weight * inverse_diagonal.segment<B>(long(B) * i);
    for (long k = a.start[i]; k < a.start[i + 1]; ++k) {
      const int j = a.column[k];
      if (aggregates.of[j] < 0) continue;
      row.at(aggregates.of[j]).noalias() += scale.asDiagonal() * (a.block[k] * tentative[j]);
    }
    row.flush(interpolation);
  }
  return coarse;
}

template <int B>
BlockMatrix<6, 6> MultigridLevel<B>::galerkin() const {
  const BlockMatrix<B, 6>& p = interpolation;
  BlockMatrix<B, 6> ap;  // A P
  ap.rows = a.rows;
  ap.columns = p.columns;
  RowSum<B, 6> row(p.columns);
  for (int i = 0; i < a.rows; ++i) {
    for (long k = a.start[i]; k < a.start[i + 1]; ++k) {
      const int j = a.column[k];
      for (long m = p.start[j]; m < p.start[j + 1]; ++m) {
        row.at(p.column[m]).noalias() += a.block[k] * p.block[m];
      }
    }
    row.flush(ap);
  }
  // The nodes that interpolate from an aggregate, so that PᵀAP is computed row by row.
  std::vector<std::vector<std::pair<int, long>>> users(std::size_t(p.columns));
  for (int i = 0; i < p.rows; ++i) {
    for (long m = p.start[i]; m < p.start[i + 1]; ++m) users[p.column[m]].emplace_back(i, m);
  }
  BlockMatrix<6, 6> coarse;
  coarse.rows = coarse.columns = p.columns;
  RowSum<6, 6> sum(p.columns);
  for (int c = 0; c < p.columns; ++c) {
    sum.at(c);
    for (const auto& [i, m] : users[c]) {
      for (long k = ap.start[i]; k < ap.start[i + 1]; ++k) {
        sum.at(ap.column[k]).noalias() += p.block[m].transpose() * ap.block[k];
      }
    }
    // Motions that an aggregate does not have (too few nodes, constrained nodes) are unknowns
    // without effect.
    Eigen::Matrix<double, 6, 6>& own = sum.at(c);
    for (int k = 0; k < 6; ++k) {
      if (own(k, k) == 0 && own.row(k).isZero(0)) own(k, k) = 1;
    }
    sum.flush(coarse);
  }
  return coarse;
}

template struct MultigridLevel<3>;
template struct MultigridLevel<6>;

}  // namespace breast
