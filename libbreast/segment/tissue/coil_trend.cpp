// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/coil_trend.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace breast {

namespace {

constexpr int degree = 4;
// Products of Legendre polynomials in x, y and z of at most this degree together, but the constant.
constexpr int terms = (degree + 1) * (degree + 2) * (degree + 3) / 6 - 1;
using Terms = Eigen::Matrix<double, terms, 1>;

std::array<double, degree + 1> legendre(double t) {
  std::array<double, degree + 1> p{1, t};
  for (int n = 2; n <= degree; ++n) p[n] = ((2 * n - 1) * t * p[n - 1] - (n - 1) * p[n - 2]) / n;
  return p;
}

/// The bounding box of the numbered blocks, mapped to [-1, 1]³, on which the polynomials are
/// defined.
class CubeOfBlocks {
 public:
  explicit CubeOfBlocks(const Blocks& blocks) : grid_(blocks.level.grid) {
    first_ = grid_.size;
    for (std::size_t n = 0; n < blocks.number.size(); ++n) {
      if (blocks.number[n] < 0) continue;
      const auto at = index(n);
      for (int d = 0; d < 3; ++d) {
        first_[d] = std::min(first_[d], at[d]);
        last_[d] = std::max(last_[d], at[d]);
      }
    }
  }
  Terms terms_at(std::size_t n) const {
    const auto at = index(n);
    std::array<std::array<double, degree + 1>, 3> p;
    for (int d = 0; d < 3; ++d)
      p[d] = legendre(2.0 * (at[d] - first_[d]) / std::max(1, last_[d] - first_[d]) - 1);
    Terms found;
    int term = 0;
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b)
        for (int c = 0; a + b + c <= degree; ++c)
          if (a + b + c > 0) found[term++] = p[0][a] * p[1][b] * p[2][c];
    return found;
  }

 private:
  std::array<int, 3> index(std::size_t n) const {
    const int i = int(n % grid_.size[0]), rest = int(n / grid_.size[0]);
    return {i, rest % grid_.size[1], rest / grid_.size[1]};
  }
  Grid grid_;
  std::array<int, 3> first_, last_{};
};

/// The coefficients with the least sum of absolute differences, by iteratively reweighted least
/// squares. Differences below `sure`, the noise of a link, count as squares.
Terms least_absolute(const std::vector<Terms>& rows, const std::vector<BlockLink>& links) {
  constexpr double sure = 0.01;
  constexpr int passes = 30;
  Terms found = Terms::Zero();
  for (int pass = 0; pass < passes; ++pass) {
    Eigen::Matrix<double, terms, terms> normal = Eigen::Matrix<double, terms, terms>::Zero();
    Terms right = Terms::Zero();
    for (std::size_t n = 0; n < links.size(); ++n) {
      const double off = std::abs(links[n].change - rows[n].dot(found));
      const double weight = pass == 0 ? 1 : 1 / std::max(sure, off);
      normal.selfadjointView<Eigen::Lower>().rankUpdate(rows[n], weight);
      right += weight * links[n].change * rows[n];
    }
    // A breast of few blocks does not determine all terms.
    const double little = 1e-6 * normal.trace() / terms + 1e-12;
    normal.diagonal().array() += little;
    found = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  }
  return found;
}

}  // namespace

std::vector<double> coil_trend(const Blocks& blocks) {
  std::vector<double> trend(blocks.number.size(), 0);
  const std::vector<BlockLink> links = links_of(blocks);
  if (links.empty()) return trend;
  const CubeOfBlocks cube(blocks);
  std::vector<Terms> rows(links.size());
  for (std::size_t n = 0; n < links.size(); ++n)
    rows[n] = cube.terms_at(links[n].to) - cube.terms_at(links[n].from);
  const Terms found = least_absolute(rows, links);
  double mean = 0;
  for (std::size_t n = 0; n < trend.size(); ++n) {
    if (blocks.number[n] < 0) continue;
    trend[n] = cube.terms_at(n).dot(found);
    mean += trend[n] / blocks.count;
  }
  for (std::size_t n = 0; n < trend.size(); ++n)
    if (blocks.number[n] >= 0) trend[n] -= mean;
  return trend;
}

void remove_coil_trend(Blocks& blocks) {
  const std::vector<double> coil = coil_trend(blocks);
  for (std::size_t n = 0; n < coil.size(); ++n) blocks.level.voxels[n] -= float(coil[n]);
}

}  // namespace breast
