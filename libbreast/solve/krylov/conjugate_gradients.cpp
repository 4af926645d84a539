// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/krylov/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

namespace breast {

ConjugateGradientResult conjugate_gradients(const LinearMap& a, const LinearMap& p,
                                            const Eigen::VectorXd& b,
                                            const ConjugateGradientLimits& limits) {
  ConjugateGradientResult result;
  result.x = Eigen::VectorXd::Zero(b.size());
  Eigen::VectorXd r = b, z = p(r), d = z;
  double rz = r.dot(z);
  result.start = std::sqrt(rz);
  const double goal = std::max(limits.relative * result.start, limits.absolute);
  while (rz > goal * goal && result.iterations < limits.iterations) {
    const Eigen::VectorXd ad = a(d);
    const double curvature = d.dot(ad);
    if (!(curvature > 0)) break;
    const double alpha = rz / curvature;
    result.x += alpha * d;
    r -= alpha * ad;
    z = p(r);
    const double next = r.dot(z);
    d = z + (next / rz) * d;
    rz = next;
    ++result.iterations;
  }
  result.residual = std::sqrt(rz);
  result.converged = rz <= goal * goal && result.x.allFinite();
  return result;
}

}  // namespace breast
