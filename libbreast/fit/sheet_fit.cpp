// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/sheet_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "fit/closest_point.hpp"
#include "fit/hermite_basis.hpp"
#include "fit/line_solve.hpp"

namespace breast {

namespace {

using PatchMatrix = Eigen::Matrix<double, 48, 48>;
using PatchVector = Eigen::Matrix<double, 48, 1>;

/// Integral of the squared second derivatives over one patch, for one component.
Eigen::Matrix<double, 16, 16> bending(int nu, int nv) {
  const double at[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                        0.9305681557970263};
  const double weight[4] = {0.17392742256872692, 0.32607257743127307, 0.32607257743127307,
                            0.17392742256872692};
  Eigen::Matrix<double, 16, 16> matrix = Eigen::Matrix<double, 16, 16>::Zero();
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const PatchWeights w = patch_weights(nu, nv, Vec2(at[i] / nu, at[j] / nv));
      const double area = weight[i] * weight[j] / (double(nu) * nv);
      for (int a = 0; a < 16; ++a)
        for (int b = 0; b < 16; ++b)
          matrix(a, b) += area * (w.ss[a] * w.ss[b] + 2 * w.st[a] * w.st[b] + w.tt[a] * w.tt[b]);
    }
  return matrix;
}

/// Data indices of every patch, in order: the sums do not depend on the number of threads.
std::vector<std::vector<int>> sort_by_patch(int nu, int nv, const SheetData& data) {
  std::vector<std::vector<int>> members(std::size_t(nu) * nv);
  for (std::size_t k = 0; k < data.points.size(); ++k) {
    const PatchWeights w = patch_weights(nu, nv, data.st[k]);
    members[std::size_t(w.patch_j) * nu + w.patch_i].push_back(int(k));
  }
  return members;
}

/// Adds to the lower triangle of `matrix` and to `right`.
void add_data(int nu, int nv, const SheetData& data, const std::vector<int>& members, double scale,
              PatchMatrix& matrix, PatchVector& right) {
  for (const int k : members) {
    const PatchWeights w = patch_weights(nu, nv, data.st[k]);
    const Vec3& n = data.normals[k];
    const double b = data.tangential[k];
    const Mat3 metric =
        scale * data.weights[k] * (b * Mat3::Identity() + (1 - b) * n * n.transpose());
    const Vec3 pull = metric * data.points[k];
    for (int p = 0; p < 16; ++p) {
      right.segment<3>(3 * p) += w.value[p] * pull;
      for (int q = 0; q <= p; ++q)
        matrix.block<3, 3>(3 * p, 3 * q) += w.value[p] * w.value[q] * metric;
    }
  }
}

struct PatchSystem {
  PatchMatrix matrix;
  PatchVector right;
};

std::vector<PatchSystem> patch_systems(int nu, int nv, const SheetData& data, double total,
                                       double smoothing) {
  const auto members = sort_by_patch(nu, nv, data);
  const Eigen::Matrix<double, 16, 16> bend = smoothing * bending(nu, nv);
  std::vector<PatchSystem> systems(members.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < members.size(); ++p) {
    auto& [matrix, right] = systems[p];
    matrix.setZero();
    right.setZero();
    for (int a = 0; a < 16; ++a)
      for (int b = 0; b < 16; ++b)
        for (int c = 0; c < 3; ++c) matrix(3 * a + c, 3 * b + c) = bend(a, b);
    add_data(nu, nv, data, members[p], 1 / total, matrix, right);
    matrix.triangularView<Eigen::StrictlyUpper>() = matrix.transpose();
  }
  return systems;
}

/// The nodes, of twelve unknowns each, in lines along the shorter side.
struct NodeLines {
  int nu, nv;
  int across() const { return std::min(nu, nv) + 1; }
  int count() const { return std::max(nu, nv) + 1; }
  int line(int i, int j) const { return nu <= nv ? j : i; }
  int within(int i, int j) const { return 12 * (nu <= nv ? i : j); }
  int first_unknown(int i, int j) const { return 12 * across() * line(i, j) + within(i, j); }
};

/// Adds a patch whose first node is (i, j).
void add_patch(const NodeLines& nodes, int i, int j, const PatchSystem& patch, LineMatrix& matrix,
               Eigen::VectorXd& right) {
  for (int a = 0; a < 4; ++a) {
    const int ia = i + (a & 1), ja = j + (a >> 1), line = nodes.line(ia, ja);
    right.segment<12>(nodes.first_unknown(ia, ja)) += patch.right.segment<12>(12 * a);
    for (int b = 0; b < 4; ++b) {
      const int ib = i + (b & 1), jb = j + (b >> 1), other = nodes.line(ib, jb);
      if (other > line) continue;
      auto& block = other == line ? matrix.own[line] : matrix.before[line];
      block.block<12, 12>(nodes.within(ia, ja), nodes.within(ib, jb)) +=
          patch.matrix.block<12, 12>(12 * a, 12 * b);
    }
  }
}

}  // namespace

HermiteSheet solve_sheet(int nu, int nv, const SheetData& data, double smoothing) {
  double total = 0;
  for (const double w : data.weights) total += w;
  if (!(total > 0)) throw failed_error("a sheet has no data to fit");
  const auto systems = patch_systems(nu, nv, data, total, smoothing);
  const NodeLines nodes{nu, nv};
  const int width = 12 * nodes.across();
  const std::vector<Eigen::MatrixXd> zero(nodes.count(), Eigen::MatrixXd::Zero(width, width));
  LineMatrix matrix{zero, zero};
  Eigen::VectorXd answer = Eigen::VectorXd::Zero(width * nodes.count());
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      add_patch(nodes, i, j, systems[std::size_t(j) * nu + i], matrix, answer);
  if (!solve_lines(matrix, answer))
    throw failed_error("the sheet's least squares with smoothing ", smoothing, " are singular");
  if (!answer.allFinite()) throw failed_error("the sheet's least squares have no finite answer");

  HermiteSheet sheet;
  sheet.nu = nu;
  sheet.nv = nv;
  sheet.nodes.resize(std::size_t(nu + 1) * (nv + 1));
  std::vector<Vec3> dofs;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i)
      for (int k = 0; k < 4; ++k)
        dofs.push_back(answer.segment<3>(nodes.first_unknown(i, j) + 3 * k));
  set_sheet_dofs(sheet, dofs);
  return sheet;
}

double project(const HermiteSheet& sheet, SheetData& data) {
  std::vector<double> distance(data.points.size(), 0);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t k = 0; k < data.points.size(); ++k) {
    if (!data.fixed[k]) {
      const SheetFoot foot = closest_from(sheet, data.points[k], data.st[k]);
      data.st[k] = foot.st;
      distance[k] = foot.distance;
    }
    const SheetPoint at = sheet.evaluate(data.st[k]);
    const Vec3 n = at.x_s.cross(at.x_t);
    if (n.norm() > 1e-9) data.normals[k] = n.normalized();
  }
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < distance.size(); ++k)
    if (!data.fixed[k])
      sum += data.weights[k] * distance[k] * distance[k], total += data.weights[k];
  return total > 0 ? std::sqrt(sum / total) : 0;
}

namespace {

/// Cauchy weights from the points' distances to the sheet, on top of `prior`.
void weigh_outliers(const HermiteSheet& sheet, const std::vector<double>& prior, double scale,
                    SheetData& data) {
  for (std::size_t k = 0; k < data.points.size(); ++k) {
    const bool trusted = data.fixed[k] || (!data.trusted.empty() && data.trusted[k]);
    const double ratio = (sheet.position(data.st[k]) - data.points[k]).norm() / scale;
    data.weights[k] = trusted ? prior[k] : prior[k] / (1 + ratio * ratio);
  }
}

}  // namespace

FitOutcome fit_sheet(int nu, int nv, SheetData& data, const FitControl& control,
                     const std::function<bool(const HermiteSheet&)>& acceptable) {
  FitOutcome best;
  double smoothing = control.smoothing > 0 ? control.smoothing : 1e-6;
  int loops = 0, settled = 0;
  bool lowering = control.smoothing <= 0;
  const std::vector<double> prior = data.weights;
  while (settled <= control.settle && loops < 40) {
    HermiteSheet sheet = solve_sheet(nu, nv, data, smoothing);
    ++loops;
    if (!acceptable(sheet)) {
      if (best.loops == 0) {  // the first start was too rough: stiffen it
        smoothing *= 16;
        if (!(smoothing < 1)) break;
        continue;
      }
      break;
    }
    data.weights = prior;
    const double rms = project(sheet, data);
    if (control.outlier_mm > 0)
      weigh_outliers(sheet, prior, std::max(control.outlier_mm, 4 * rms), data);
    best = {std::move(sheet), smoothing, rms, loops, rms <= control.target_rms_mm};
    const bool close = rms <= control.target_rms_mm &&
                       (!control.close_enough || control.close_enough(best.sheet, data));
    if (lowering && !close && smoothing / 4 >= control.least_smoothing)
      smoothing /= 4;
    else
      ++settled, lowering = false;
  }
  if (best.loops == 0)
    throw not_converged_error(
        "no sheet of ", nu, " x ", nv,
        " patches without folds was found; try --smoothing or other --elements");
  best.loops = loops;
  return best;
}

FoldCheck check_folds(const HermiteSheet& sheet, int per_patch) {
  const int columns = sheet.nu * per_patch + 1, rows = sheet.nv * per_patch + 1;
  std::vector<Vec3> normal(std::size_t(columns) * rows);
  std::vector<double> area(normal.size());
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const SheetPoint p = sheet.evaluate({double(i) / (columns - 1), double(j) / (rows - 1)});
      const Vec3 n = p.x_s.cross(p.x_t);
      const std::size_t at = std::size_t(j) * columns + i;
      area[at] = n.norm();
      normal[at] = n / std::max(1e-12, area[at]);
    }
  FoldCheck check;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::size_t at = std::size_t(j) * columns + i;
      if (i + 1 < columns)
        check.min_cosine = std::min(check.min_cosine, normal[at].dot(normal[at + 1]));
      if (j + 1 < rows)
        check.min_cosine = std::min(check.min_cosine, normal[at].dot(normal[at + columns]));
    }
  check.min_area_ratio =
      *std::min_element(area.begin(), area.end()) / std::max(1e-12, median(area));
  return check;
}

}  // namespace breast
