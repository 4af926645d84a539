// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/multigrid/multigrid.hpp"

#include <Eigen/Cholesky>
#include <memory>

#include "solve/multigrid/impl.hpp"
#include "solve/multigrid/settings.hpp"

namespace breast {

namespace {

constexpr int coarsest_nodes = 150, most_levels = 12;

// Translations and rotations about the middle of the body, of the size of a millimetre each.
Motions<3> rigid_motions(const Constraints& constraints, const Eigen::VectorXd& positions) {
  const long nodes = positions.size() / 3;
  Vec3 middle = Vec3::Zero();
  for (long i = 0; i < nodes; ++i) middle += positions.segment<3>(3 * i) / double(nodes);
  double size = 0;
  for (long i = 0; i < nodes; ++i) {
    size = std::max(size, (positions.segment<3>(3 * i) - middle).norm());
  }
  Motions<3> motions;
  for (long i = 0; i < nodes; ++i) {
    const Vec3 arm = (positions.segment<3>(3 * i) - middle) / size;
    motions.push_back(rigid_motion(arm, constraints.at(int(i))));
  }
  return motions;
}

}  // namespace

Eigen::Matrix<double, 3, 6> rigid_motion(const Vec3& arm, const NodeConstraint* held) {
  Eigen::Matrix<double, 3, 6> motion;
  motion.leftCols<3>().setIdentity();
  motion.rightCols<3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  if (held == nullptr) return motion;
  motion = (held->axes.transpose() * motion).eval();
  for (int k = 0; k < 3; ++k) {
    if (held->held[k]) motion.row(k).setZero();
  }
  return motion;
}

struct Multigrid::Impl {
  MultigridLevel<3> finest;
  std::vector<std::unique_ptr<MultigridLevel<6>>> coarser;
  Eigen::LLT<Eigen::MatrixXd> bottom;

  // The coarse correction of a level, then the smoother again: a symmetric cycle.
  template <int B>
  Eigen::VectorXd cycle(const MultigridLevel<B>& level, std::size_t next,
                        const Eigen::VectorXd& right) const {
    Eigen::VectorXd x, residual;
    level.smooth(right, x);
    level.a.multiply(x, residual);
    residual = right - residual;
    Eigen::VectorXd coarse = Eigen::VectorXd::Zero(6L * level.interpolation.columns), fine;
    level.interpolation.add_transposed(residual, coarse);
    if (next == coarser.size()) {
      coarse = bottom.solve(coarse);
    } else {
      coarse = cycle(*coarser[next], next + 1, coarse);
    }
    level.interpolation.multiply(coarse, fine);
    x += fine;
    level.smooth(right, x);
    return x;
  }

  bool factor_bottom(const BlockMatrix<6, 6>& a) {
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(6L * a.rows, 6L * a.rows);
    for (int i = 0; i < a.rows; ++i) {
      for (long k = a.start[i]; k < a.start[i + 1]; ++k) {
        dense.block<6, 6>(6L * i, 6L * a.column[k]) += a.block[k];
      }
    }
    bottom.compute(dense);
    return bottom.info() == Eigen::Success;
  }
};

Multigrid::Multigrid() = default;
Multigrid::~Multigrid() = default;

bool Multigrid::build(const NodeMatrix& matrix, const Constraints& constraints,
                      const Eigen::VectorXd& positions) {
  impl_ = std::make_unique<Impl>();
  Impl& m = *impl_;
  m.finest.a = full_matrix(matrix);
  if (!m.finest.prepare()) return false;
  Motions<6> motions = m.finest.coarsen(rigid_motions(constraints, positions), strong_coupling);
  BlockMatrix<6, 6> a = m.finest.galerkin();
  double threshold = strong_coupling;
  while (a.rows > coarsest_nodes && m.coarser.size() < most_levels) {
    auto level = std::make_unique<MultigridLevel<6>>();
    level->a = std::move(a);
    if (!level->prepare()) return false;
    threshold *= coupling_decay;
    motions = level->coarsen(motions, threshold);
    a = level->galerkin();
    m.coarser.push_back(std::move(level));
    if (a.rows > m.coarser.back()->a.rows / 2) break;
  }
  return m.factor_bottom(a);
}

Eigen::VectorXd Multigrid::cycle(const Eigen::VectorXd& right) const {
  return impl_->cycle(impl_->finest, 0, right);
}

Eigen::VectorXd Multigrid::multiply(const Eigen::VectorXd& v) const {
  Eigen::VectorXd out;
  impl_->finest.a.multiply(v, out);
  return out;
}

int Multigrid::levels() const {
  return 2 + int(impl_->coarser.size());
}

double Multigrid::complexity() const {
  const double fine = 9.0 * double(impl_->finest.a.block.size());
  double all = fine + double(impl_->bottom.rows() * impl_->bottom.rows());
  for (const auto& level : impl_->coarser) all += 36.0 * double(level->a.block.size());
  return all / fine;
}

}  // namespace breast
