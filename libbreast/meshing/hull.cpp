// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/hull.hpp"

#include <Eigen/LU>
#include <cmath>

namespace breast {

namespace {

bool is_sheet(Hull part) {
  return part == Hull::skin || part == Hull::wall;
}

// The columns are the derivatives with respect to the parameters; that of the height is 0 on a rim.
Eigen::Matrix<double, 3, 2> slopes(const BodyMap& body, Hull part, const Vec2& at) {
  Eigen::Matrix<double, 3, 2> columns;
  if (is_sheet(part)) {
    const HermiteSheet& sheet = part == Hull::skin ? body.skin_sheet() : body.wall_sheet();
    const SheetPoint point = sheet.evaluate(at);
    columns << point.x_s, point.x_t;
    return columns;
  }
  columns = body.cut_slopes(at.y(), at.x());
  if (part != Hull::cut) columns.col(1).setZero();
  return columns;
}

}  // namespace

HullPoint hull_point(const BodyMap& body, Hull part, const Vec2& at) {
  if (part == Hull::skin) return {at, body.skin_sheet().position(at)};
  if (part == Hull::wall) return {at, body.wall_sheet().position(at)};
  return {at, body.cut(at.y(), at.x())};
}

HullPoint hull_point_of_node(const BodyMap& body, Hull part, const PlacedNodes& nodes, int node) {
  const Vec2& at = nodes.st[node];
  const bool rim = is_sheet(part) && nodes.support[node] == Support::cut;
  if (!rim) return hull_point(body, part, at);
  return hull_point(body, part, part == Hull::skin ? body.skin(1, at.x()) : body.wall(1, at.x()));
}

Vec2 mean_parameters(Hull part, const std::vector<Vec2>& at, const std::vector<double>& weights) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < at.size(); ++i) {
    Vec2 value = at[i];
    if (!is_sheet(part)) value.x() -= std::round(value.x() - at[0].x());
    sum += weights[i] * value;
  }
  return sum;
}

HullPoint nearest_on_hull(const BodyMap& body, Hull part, const Vec2& start, const Vec3& x) {
  constexpr int steps = 6;
  constexpr double converged = 1e-9;  // mm
  HullPoint best = hull_point(body, part, start);
  for (int step = 0; step < steps; ++step) {
    const Eigen::Matrix<double, 3, 2> columns = slopes(body, part, best.at);
    Eigen::Matrix2d normal = columns.transpose() * columns;
    if (part == Hull::skin_rim || part == Hull::wall_rim) normal(1, 1) = 1;
    const Vec2 move = normal.inverse() * (columns.transpose() * (x - best.x));
    if (!move.allFinite()) break;
    const HullPoint next = hull_point(body, part, best.at + move);
    if (!((next.x - x).squaredNorm() < (best.x - x).squaredNorm())) break;
    const bool done = (next.x - best.x).norm() < converged;
    best = next;
    if (done) break;
  }
  return best;
}

}  // namespace breast
