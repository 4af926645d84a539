#include "fit/sheet_fit.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/blas.hpp"
#include "core/error.hpp"
#include "fit/closest_point.hpp"
#include "fit/hermite_basis.hpp"

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
      for (int q = 0; q < 16; ++q)
        matrix.block<3, 3>(3 * p, 3 * q) += w.value[p] * w.value[q] * metric;
    }
  }
}

}  // namespace

HermiteSheet solve_sheet(int nu, int nv, const SheetData& data, double smoothing) {
  double total = 0;
  for (const double w : data.weights) total += w;
  if (!(total > 0)) throw failed_error("a sheet has no data to fit");
  const auto members = sort_by_patch(nu, nv, data);
  const Eigen::Matrix<double, 16, 16> bend = smoothing * bending(nu, nv);
  std::vector<PatchMatrix> matrices(members.size());
  std::vector<PatchVector> rights(members.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < members.size(); ++p) {
    PatchMatrix& matrix = matrices[p];
    matrix.setZero();
    rights[p].setZero();
    for (int a = 0; a < 16; ++a)
      for (int b = 0; b < 16; ++b)
        for (int c = 0; c < 3; ++c) matrix(3 * a + c, 3 * b + c) = bend(a, b);
    add_data(nu, nv, data, members[p], 1 / total, matrix, rights[p]);
  }

  const int nodes = (nu + 1) * (nv + 1), size = 12 * nodes;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(members.size() * 48 * 25 + std::size_t(size));
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const std::size_t p = std::size_t(j) * nu + i;
      int row[48];
      for (int a = 0; a < 16; ++a) {
        const int c = a / 4, node = (j + (c >> 1)) * (nu + 1) + i + (c & 1);
        for (int k = 0; k < 3; ++k) row[3 * a + k] = 12 * node + 3 * (a % 4) + k;
      }
      for (int a = 0; a < 48; ++a) {
        right[row[a]] += rights[p][a];
        for (int b = 0; b < 48; ++b)
          if (row[a] >= row[b]) entries.emplace_back(row[a], row[b], matrices[p](a, b));
      }
    }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  prepare_blas();
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Lower> factor;
  factor.cholmod().print = 0;
  factor.compute(matrix);
  if (factor.info() != Eigen::Success)
    throw failed_error("the sheet's least squares with smoothing ", smoothing, " are singular");
  const Eigen::VectorXd answer = factor.solve(right);
  if (!answer.allFinite()) throw failed_error("the sheet's least squares have no finite answer");

  HermiteSheet sheet;
  sheet.nu = nu;
  sheet.nv = nv;
  sheet.nodes.resize(nodes);
  std::vector<Vec3> dofs(4 * std::size_t(nodes));
  for (std::size_t d = 0; d < dofs.size(); ++d) dofs[d] = answer.segment<3>(Eigen::Index(3 * d));
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
  std::vector<double> sorted = area;
  std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2),
                   sorted.end());
  const double median = sorted[sorted.size() / 2];
  check.min_area_ratio = *std::min_element(area.begin(), area.end()) / std::max(1e-12, median);
  return check;
}

}  // namespace breast
