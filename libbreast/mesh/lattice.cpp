// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/lattice.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/shape.hpp"

namespace breast::lattice {

namespace {

std::vector<int> invert_vtk_order(int order) {
  const int side = order + 1;
  std::vector<int> vtk(std::size_t(side) * side * side);
  for (int a = 0; a < int(vtk.size()); ++a) {
    const Vec3 at = 0.5 * order * (hex_node_local(order, a) + Vec3::Ones());
    vtk[std::size_t(std::lround(at.x()) +
                    side * (std::lround(at.y()) + side * std::lround(at.z())))] = a;
  }
  return vtk;
}

template <int Order>
void line(double x, double* value, double* slope) {
  if constexpr (Order == 1) {
    value[0] = 0.5 * (1 - x), value[1] = 0.5 * (1 + x);
    slope[0] = -0.5, slope[1] = 0.5;
  } else {
    value[0] = 0.5 * x * (x - 1), value[1] = 1 - x * x, value[2] = 0.5 * x * (x + 1);
    slope[0] = x - 0.5, slope[1] = -2 * x, slope[2] = x + 0.5;
  }
}

template <int Order>
void evaluate_order(const Vec3* points, const Vec3& local, Vec3& x, Mat3& jacobian) {
  constexpr int n = Order + 1;
  double u[n], v[n], w[n], du[n], dv[n], dw[n];
  line<Order>(local.x(), u, du);
  line<Order>(local.y(), v, dv);
  line<Order>(local.z(), w, dw);
  x.setZero();
  jacobian.setZero();
  for (int k = 0, a = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      Vec3 along = Vec3::Zero(), slope = Vec3::Zero();
      for (int i = 0; i < n; ++i, ++a) {
        along += u[i] * points[a];
        slope += du[i] * points[a];
      }
      x += v[j] * w[k] * along;
      jacobian.col(0) += v[j] * w[k] * slope;
      jacobian.col(1) += dv[j] * w[k] * along;
      jacobian.col(2) += v[j] * dw[k] * along;
    }
  }
}

// One Levenberg-Marquardt step on the coordinates that are free, projected onto the box.
Vec3 projected_step(const Mat3& jacobian, const Vec3& gradient, const Vec3& local, int fixed,
                    double damping) {
  Mat3 hessian = jacobian.transpose() * jacobian;
  hessian.diagonal() *= 1 + damping;
  Vec3 right = -gradient;
  for (int d = 0; d < 3; ++d) {
    const bool at_wall = (local[d] >= 1 && gradient[d] < 0) || (local[d] <= -1 && gradient[d] > 0);
    if (d != fixed && !at_wall) continue;
    hessian.row(d).setZero();
    hessian.col(d).setZero();
    hessian(d, d) = 1;
    right[d] = 0;
  }
  const Vec3 moved = local + hessian.partialPivLu().solve(right);
  return moved.cwiseMax(-1.0).cwiseMin(1.0);
}

}  // namespace

const int* vtk_nodes(int order) {
  static const std::vector<int> linear = invert_vtk_order(1), quadratic = invert_vtk_order(2);
  return order == 1 ? linear.data() : quadratic.data();
}

void evaluate(int order, const Vec3* points, const Vec3& local, Vec3& x, Mat3& jacobian) {
  if (order == 1) {
    evaluate_order<1>(points, local, x, jacobian);
  } else {
    evaluate_order<2>(points, local, x, jacobian);
  }
}

double closest_in_element(int order, const Vec3* points, const Vec3& point, int fixed, Vec3 start,
                          Vec3& local) {
  local = start;
  Vec3 x;
  Mat3 jacobian;
  evaluate(order, points, local, x, jacobian);
  double best = (x - point).squaredNorm(), damping = 1e-6;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Vec3 gradient = jacobian.transpose() * (x - point);
    const Vec3 trial = projected_step(jacobian, gradient, local, fixed, damping);
    if (!((trial - local).cwiseAbs().maxCoeff() > 1e-12)) break;
    Vec3 trial_x;
    Mat3 trial_jacobian;
    evaluate(order, points, trial, trial_x, trial_jacobian);
    const double distance = (trial_x - point).squaredNorm();
    if (distance <= best) {
      const bool settled = best - distance <= 1e-14 * best;
      local = trial, x = trial_x, jacobian = trial_jacobian, best = distance;
      damping = std::max(1e-9, damping / 10);
      if (settled) break;
    } else {
      damping *= 10;
    }
  }
  return best;
}

}  // namespace breast::lattice
