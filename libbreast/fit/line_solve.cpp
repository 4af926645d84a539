// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/line_solve.hpp"

#include <Eigen/Cholesky>

namespace breast {

bool solve_lines(LineMatrix& matrix, Eigen::VectorXd& right) {
  auto& [own, before] = matrix;
  if (own.empty()) return true;
  const Eigen::Index m = own.front().rows(), n = Eigen::Index(own.size());
  const auto line = [&](Eigen::Index l) { return right.segment(l * m, m); };
  for (Eigen::Index l = 0; l < n; ++l) {
    if (l > 0) {
      own[l - 1].triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
          before[l]);
      own[l].selfadjointView<Eigen::Lower>().rankUpdate(before[l], -1);
      line(l).noalias() -= before[l] * line(l - 1);
    }
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(own[l]);
    if (factor.info() != Eigen::Success) return false;
    auto x = line(l);
    own[l].triangularView<Eigen::Lower>().solveInPlace(x);
  }
  for (Eigen::Index l = n - 1; l >= 0; --l) {
    auto x = line(l);
    if (l + 1 < n) x.noalias() -= before[l + 1].transpose() * line(l + 1);
    own[l].triangularView<Eigen::Lower>().transpose().solveInPlace(x);
  }
  return true;
}

}  // namespace breast
