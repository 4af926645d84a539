// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/wall/ellipse_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"

namespace breast {

namespace {

constexpr int parameters = 5;  // centre x and y, slope, half width, half depth
using Vector = Eigen::Matrix<double, parameters, 1>;
using Matrix = Eigen::Matrix<double, parameters, parameters>;

constexpr int iterations = 60;
// The data, however many, count as this many independent points with this error (mm): ribs are not
// an ellipse.
constexpr double independent = 60, model_error = 4, outlier = 10;

/// Distance of a point from the surface to first order, and its derivatives.
struct Misfit {
  double distance = 0;
  Vector slope = Vector::Zero();
};

Misfit misfit(const EllipticCylinder& e, const Vec3& p) {
  const double u = p.x() - e.centre_x, v = e.centre_y + e.slope * (p.z() - e.z0) - p.y();
  const double a2 = e.half_width * e.half_width, b2 = e.half_depth * e.half_depth;
  const double f = std::sqrt(u * u / a2 + v * v / b2);
  const double fu = u / (a2 * f), fv = v / (b2 * f);
  const double size = std::sqrt(fu * fu + fv * fv + e.slope * e.slope * fv * fv);
  Misfit out;
  out.distance = (f - 1) / size;
  out.slope << -fu, fv, fv * (p.z() - e.z0), -fu * u / e.half_width, -fv * v / e.half_depth;
  out.slope /= size;
  return out;
}

}  // namespace

double EllipticCylinder::radius(double angle) const {
  const double s = elementary::sin(angle) / half_width, c = elementary::cos(angle) / half_depth;
  return 1 / std::sqrt(s * s + c * c);
}

EllipticCylinder fit_elliptic_cylinder(const std::vector<Vec3>& points,
                                       const std::vector<double>& weights,
                                       const Expected& centre_x) {
  double front = 0, height = 0, total = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    front = k == 0 ? points[k].y() : std::min(front, points[k].y());
    height += weights[k] * points[k].z();
    total += weights[k];
  }
  Vector expected, sigma;
  expected << centre_x.value, front + 95, 0, 135, 95;
  sigma << centre_x.sigma, 40, 0.3, 15, 15;
  EllipticCylinder e{expected[0], expected[1], height / total, 0, expected[3], expected[4]};
  const double scale = independent / (total * model_error * model_error);
  for (int i = 0; i < iterations; ++i) {
    Vector now;
    now << e.centre_x, e.centre_y, e.slope, e.half_width, e.half_depth;
    Matrix normal = sigma.array().square().inverse().matrix().asDiagonal();
    Vector right = normal * (expected - now);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Misfit m = misfit(e, points[k]);
      const double ratio = m.distance / outlier;
      const double w = scale * weights[k] / (1 + ratio * ratio);
      normal += w * m.slope * m.slope.transpose();
      right -= w * m.distance * m.slope;
    }
    const Vector step = normal.ldlt().solve(right);
    // Far from the data's own ellipse a full step may turn an axis negative.
    const double longest = std::max(std::abs(step[3]), std::abs(step[4]));
    const double part = std::min(1.0, 20 / std::max(20.0, longest));
    e.centre_x += part * step[0];
    e.centre_y += part * step[1];
    e.slope += part * step[2];
    e.half_width += part * step[3];
    e.half_depth += part * step[4];
  }
  return e;
}

}  // namespace breast
