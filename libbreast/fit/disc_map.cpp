// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/disc_map.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

/// Corner points of the border in the order (0,0) (1,0) (1,1) (0,1), as positions along the loop.
std::array<std::size_t, 4> corners(const DiscSurface& surface) {
  const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int n : surface.border) {
    low = low.cwiseMin(surface.points[n]);
    high = high.cwiseMax(surface.points[n]);
  }
  std::array<std::size_t, 4> corner{};
  for (int c = 0; c < 4; ++c) {
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < surface.border.size(); ++i) {
      const Vec3& p = surface.points[surface.border[i]];
      const double x = (p.x() - low.x()) / (high.x() - low.x());
      const double z = (p.z() - low.z()) / (high.z() - low.z());
      // Among equally extreme points the anterior one: the loop may run far back at the sides.
      const double score = sign[c][0] * x + sign[c][1] * z - 1e-3 * (p.y() - low.y());
      if (score > best) best = score, corner[c] = i;
    }
  }
  return corner;
}

void lay_border(const DiscSurface& surface, std::vector<Vec2>& st) {
  const std::size_t n = surface.border.size();
  const auto corner = corners(surface);
  const auto ahead = [&](int c) { return (corner[c] + n - corner[0]) % n; };
  if (!(ahead(1) > 0 && ahead(2) > ahead(1) && ahead(3) > ahead(2)))
    throw input_error(
        "labels: the rim of the skin around the breast has no four corners in order; "
        "the body mask is too ragged at the border of the box");
  const Vec2 square[5] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int c = 0; c < 4; ++c) {
    const std::size_t steps = (corner[(c + 1) % 4] + n - corner[c]) % n;
    std::vector<double> along(steps + 1, 0);
    for (std::size_t i = 1; i <= steps; ++i) {
      const Vec3& a = surface.points[surface.border[(corner[c] + i - 1) % n]];
      const Vec3& b = surface.points[surface.border[(corner[c] + i) % n]];
      along[i] = along[i - 1] + (b - a).norm();
    }
    for (std::size_t i = 0; i < steps; ++i)
      st[surface.border[(corner[c] + i) % n]] =
          square[c] + along[i] / along[steps] * (square[c + 1] - square[c]);
  }
}

using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Mean-value weights w_ij = (tan(a/2) + tan(b/2)) / |ij|, a and b the
/// angles at i beside the edge ij.
Weights mean_value_weights(const DiscSurface& surface) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& t : surface.triangles)
    for (int v = 0; v < 3; ++v) {
      const int i = t[v], j = t[(v + 1) % 3], k = t[(v + 2) % 3];
      const Vec3 a = surface.points[j] - surface.points[i],
                 b = surface.points[k] - surface.points[i];
      // tan(angle/2) = |a x b| / (|a||b| + a.b)
      const double half = a.cross(b).norm() / std::max(1e-12, a.norm() * b.norm() + a.dot(b));
      entries.emplace_back(i, j, half / a.norm());
      entries.emplace_back(i, k, half / b.norm());
    }
  Weights w(Eigen::Index(surface.points.size()), Eigen::Index(surface.points.size()));
  w.setFromTriplets(entries.begin(), entries.end());
  return w;
}

using Solver = Eigen::SparseLU<Eigen::SparseMatrix<double>>;

/// Places the inner points at the weighted mean of their neighbours. `lu` keeps the order of
/// elimination from one call to the next.
void solve(const Weights& weights, const std::vector<int>& unknown_of, int unknowns, Solver& lu,
           std::vector<Vec2>& st) {
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
  for (int i = 0; i < weights.rows(); ++i) {
    const int row = unknown_of[i];
    if (row < 0) continue;
    double sum = 0;
    for (Weights::InnerIterator it(weights, i); it; ++it) sum += it.value();
    entries.emplace_back(row, row, 1);
    for (Weights::InnerIterator it(weights, i); it; ++it) {
      const int j = int(it.col());
      if (unknown_of[j] >= 0)
        entries.emplace_back(row, unknown_of[j], -it.value() / sum);
      else
        right.row(row) += it.value() / sum * st[j].transpose();
    }
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (lu.rows() == 0) lu.analyzePattern(matrix);
  lu.factorize(matrix);
  if (lu.info() != Eigen::Success)
    throw failed_error("the map of the skin to a square is singular");
  const Eigen::MatrixX2d answer = lu.solve(right);
  for (std::size_t i = 0; i < unknown_of.size(); ++i)
    if (unknown_of[i] >= 0) st[i] = answer.row(unknown_of[i]).transpose();
}

double signed_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

/// Sander's L2 stretch of the map square -> surface per point (area-weighted over its triangles);
/// returns that of the whole surface.
double stretch(const DiscSurface& surface, const std::vector<Vec2>& st,
               std::vector<double>& sigma) {
  sigma.assign(st.size(), 0);
  std::vector<double> area(st.size(), 0);
  double total = 0, total_area = 0;
  for (const auto& t : surface.triangles) {
    const Vec3 &p = surface.points[t[0]], &q = surface.points[t[1]], &r = surface.points[t[2]];
    const Vec2 &a = st[t[0]], &b = st[t[1]], &c = st[t[2]];
    const double flat = std::max(1e-12, std::abs(signed_area(a, b, c)));
    const Vec3 d_s = (p * (b.y() - c.y()) + q * (c.y() - a.y()) + r * (a.y() - b.y())) / (2 * flat);
    const Vec3 d_t = (p * (c.x() - b.x()) + q * (a.x() - c.x()) + r * (b.x() - a.x())) / (2 * flat);
    const double square = 0.5 * (d_s.squaredNorm() + d_t.squaredNorm());
    const double solid = 0.5 * (q - p).cross(r - p).norm();
    for (const int v : t) sigma[v] += solid * square, area[v] += solid;
    total += solid * square;
    total_area += solid;
  }
  for (std::size_t i = 0; i < sigma.size(); ++i)
    sigma[i] = area[i] > 0 ? std::sqrt(sigma[i] / area[i]) : 1;
  return std::sqrt(total / total_area);
}

void judge(const DiscSurface& surface, DiscMap& map) {
  double solid_total = 0;
  std::vector<double> ratio;
  for (const auto& t : surface.triangles) {
    const double flat = signed_area(map.st[t[0]], map.st[t[1]], map.st[t[2]]);
    const double solid = 0.5 * (surface.points[t[1]] - surface.points[t[0]])
                                   .cross(surface.points[t[2]] - surface.points[t[0]])
                                   .norm();
    solid_total += solid;
    if (!(flat > 0)) ++map.flipped;
    ratio.push_back(std::max(1e-12, flat) / std::max(1e-12, solid));
  }
  for (double& r : ratio) r = elementary::exp(std::abs(elementary::log(r * solid_total)));
  const auto n = std::ptrdiff_t(0.95 * double(ratio.size()));
  std::nth_element(ratio.begin(), ratio.begin() + n, ratio.end());
  map.area_ratio_p95 = ratio[std::size_t(n)];
}

}  // namespace

DiscMap map_to_square(const DiscSurface& surface, int max_solves) {
  std::vector<int> unknown_of(surface.points.size(), 0);
  for (const int n : surface.border) unknown_of[n] = -1;
  int unknowns = 0;
  for (int& u : unknown_of)
    if (u == 0) u = unknowns++;

  DiscMap best;
  std::vector<Vec2> st(surface.points.size(), Vec2(0.5, 0.5));
  lay_border(surface, st);
  Weights weights = mean_value_weights(surface);
  double best_stretch = std::numeric_limits<double>::infinity();
  std::vector<double> sigma;
  Solver lu;
  int solves = 0;
  while (solves < max_solves) {
    solve(weights, unknown_of, unknowns, lu, st);
    ++solves;
    const double now = stretch(surface, st, sigma);
    if (!(now < best_stretch)) break;
    best_stretch = now;
    best.st = st;
    for (int i = 0; i < weights.rows(); ++i)
      for (Weights::InnerIterator it(weights, i); it; ++it) it.valueRef() /= sigma[it.col()];
  }
  if (best.st.empty()) throw failed_error("the map of the skin to a square has no finite stretch");
  best.solves = solves;
  judge(surface, best);
  return best;
}

}  // namespace breast
