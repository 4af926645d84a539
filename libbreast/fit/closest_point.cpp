// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/closest_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/hermite_basis.hpp"

namespace breast {

namespace {

/// Newton direction of half the squared distance on the coordinates that are free to move.
Vec2 newton_step(const HermiteSheet& sheet, const SheetPoint& at, const Vec3& r, const Vec2& st) {
  const Vec2 g(at.x_s.dot(r), at.x_t.dot(r));
  bool held[2];
  for (int a = 0; a < 2; ++a) held[a] = (st[a] <= 0 && g[a] > 0) || (st[a] >= 1 && g[a] < 0);
  if (held[0] && held[1]) return Vec2::Zero();
  Eigen::Matrix2d gauss;
  gauss << at.x_s.squaredNorm(), at.x_s.dot(at.x_t), at.x_s.dot(at.x_t), at.x_t.squaredNorm();
  const SheetCurvature k = curvature(sheet, st);
  Eigen::Matrix2d full = gauss;
  full(0, 0) += r.dot(k.x_ss);
  full(1, 1) += r.dot(k.x_tt);
  full(0, 1) += r.dot(k.x_st);
  full(1, 0) = full(0, 1);
  for (int a = 0; a < 2; ++a)
    if (held[a]) {
      Vec2 step = Vec2::Zero();
      const int b = 1 - a;
      const double h = full(b, b) > 0.05 * gauss(b, b) ? full(b, b) : gauss(b, b);
      step[b] = -g[b] / std::max(h, 1e-12);
      return step;
    }
  const bool positive = full.determinant() > 0.01 * gauss.determinant() && full.trace() > 0;
  const Eigen::Matrix2d& h = positive ? full : gauss;
  if (!(h.determinant() > 1e-12)) return -g / std::max(1e-12, gauss.trace());
  return -h.inverse() * g;
}

}  // namespace

SheetFoot closest_from(const HermiteSheet& sheet, const Vec3& target, const Vec2& start) {
  const double longest_step = 0.5 / std::max(sheet.nu, sheet.nv);
  SheetFoot foot;
  foot.st = start.cwiseMax(0).cwiseMin(1);
  SheetPoint at = sheet.evaluate(foot.st);
  double best = (at.x - target).squaredNorm();
  for (int iteration = 0; iteration < 40; ++iteration) {
    Vec2 step = newton_step(sheet, at, at.x - target, foot.st);
    const double length = step.cwiseAbs().maxCoeff();
    if (!(length > 1e-12)) break;
    if (length > longest_step) step *= longest_step / length;
    bool moved = false;
    for (int halving = 0; halving < 12 && !moved; ++halving, step *= 0.5) {
      const Vec2 trial = (foot.st + step).cwiseMax(0).cwiseMin(1);
      const SheetPoint there = sheet.evaluate(trial);
      const double now = (there.x - target).squaredNorm();
      if (now < best) {
        moved = true;
        foot.st = trial;
        at = there;
        best = now;
      }
    }
    if (!moved || length < 1e-10) break;
  }
  foot.x = at.x;
  foot.distance = std::sqrt(best);
  return foot;
}

SheetLocator::SheetLocator(const HermiteSheet& sheet, int per_patch)
    : sheet_(sheet), columns_(sheet.nu * per_patch + 1), rows_(sheet.nv * per_patch + 1) {
  sample_.reserve(std::size_t(columns_) * rows_);
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) sample_.push_back(sheet.position(parameter(i, j)));
}

SheetFoot SheetLocator::closest(const Vec3& target) const {
  std::vector<double> d(sample_.size());
  for (std::size_t n = 0; n < sample_.size(); ++n) d[n] = (sample_[n] - target).squaredNorm();
  // Local minima among the samples: on a folded-round shape more than one may lead to the answer.
  std::vector<std::pair<double, int>> seeds;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const int n = j * columns_ + i;
      bool minimum = true;
      for (int b = std::max(0, j - 1); b <= std::min(rows_ - 1, j + 1) && minimum; ++b)
        for (int a = std::max(0, i - 1); a <= std::min(columns_ - 1, i + 1); ++a)
          if (d[b * columns_ + a] < d[n]) {
            minimum = false;
            break;
          }
      if (minimum) seeds.emplace_back(d[n], n);
    }
  std::sort(seeds.begin(), seeds.end());
  SheetFoot best;
  best.distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min<std::size_t>(4, seeds.size()); ++k) {
    const int n = seeds[k].second;
    const SheetFoot foot = closest_from(sheet_, target, parameter(n % columns_, n / columns_));
    if (foot.distance < best.distance) best = foot;
  }
  return best;
}

}  // namespace breast
