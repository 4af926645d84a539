// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/krylov/gmres.hpp"

#include <cmath>
#include <vector>

namespace breast {

namespace {

// Givens rotations keep the Hessenberg matrix triangular; `g` is the rotated right-hand side.
struct Hessenberg {
  Eigen::MatrixXd h;
  Eigen::VectorXd g, c, s;
  Hessenberg(int m, double beta)
      : h(Eigen::MatrixXd::Zero(m + 1, m)),
        g(Eigen::VectorXd::Zero(m + 1)),
        c(Eigen::VectorXd::Zero(m)),
        s(Eigen::VectorXd::Zero(m)) {
    g[0] = beta;
  }
  void rotate(int j) {
    for (int i = 0; i < j; ++i) {
      const double upper = c[i] * h(i, j) + s[i] * h(i + 1, j);
      h(i + 1, j) = -s[i] * h(i, j) + c[i] * h(i + 1, j);
      h(i, j) = upper;
    }
    const double length = std::hypot(h(j, j), h(j + 1, j));
    c[j] = length > 0 ? h(j, j) / length : 1;
    s[j] = length > 0 ? h(j + 1, j) / length : 0;
    h(j, j) = length;
    g[j + 1] = -s[j] * g[j];
    g[j] *= c[j];
  }
};

}  // namespace

GmresResult gmres(const LinearMap& a, const LinearMap& p, const Eigen::VectorXd& b,
                  double tolerance, int max_iterations) {
  GmresResult result;
  result.x = Eigen::VectorXd::Zero(b.size());
  const double beta = b.norm();
  if (!(beta > 0)) {
    result.converged = beta == 0;
    return result;
  }
  std::vector<Eigen::VectorXd> v{b / beta}, z;
  Hessenberg system(max_iterations, beta);
  int j = 0;
  for (; j < max_iterations && !result.converged; ++j) {
    z.push_back(p(v[j]));
    Eigen::VectorXd w = a(z[j]);
    for (int i = 0; i <= j; ++i) {
      system.h(i, j) = w.dot(v[i]);
      w -= system.h(i, j) * v[i];
    }
    const double length = w.norm();
    system.h(j + 1, j) = length;
    system.rotate(j);
    result.residual = std::abs(system.g[j + 1]) / beta;
    result.converged = result.residual <= tolerance;
    if (!(length > 0) || !std::isfinite(length)) {
      ++j;
      break;
    }
    v.push_back(w / length);
  }
  result.iterations = j;
  const Eigen::VectorXd y =
      system.h.topLeftCorner(j, j).triangularView<Eigen::Upper>().solve(system.g.head(j));
  for (int i = 0; i < j; ++i) result.x += y[i] * z[i];
  return result;
}

}  // namespace breast
