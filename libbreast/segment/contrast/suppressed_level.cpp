// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast/suppressed_level.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

constexpr int degree = 2;  // a third would reach up to fat that is not suppressed
constexpr int terms = (degree + 1) * (degree + 2) * (degree + 3) / 6;
using Terms = Eigen::Matrix<double, terms, 1>;

/// Legendre products of at most the second degree over the box of the voxels of a mask.
class Polynomials {
 public:
  explicit Polynomials(const Mask& mask) : grid_(mask.grid) {
    first_ = grid_.size;
    for (int k = 0; k < grid_.size[2]; ++k) {
      for (int j = 0; j < grid_.size[1]; ++j) {
        for (int i = 0; i < grid_.size[0]; ++i) {
          if (!mask.at(i, j, k)) continue;
          const std::array<int, 3> at{i, j, k};
          for (int d = 0; d < 3; ++d) {
            first_[d] = std::min(first_[d], at[d]);
            last_[d] = std::max(last_[d], at[d]);
          }
        }
      }
    }
  }
  /// Outside the box, beyond a margin of a twentieth of its size, the values are those of the margin, because a polynomial must
  /// not be extrapolated.
  Terms at(const Vec3& index) const {
    constexpr double beyond = 1.1;
    std::array<std::array<double, degree + 1>, 3> p;
    for (int d = 0; d < 3; ++d) {
      const double t = std::clamp(
          2.0 * (index[d] - first_[d]) / std::max(1, last_[d] - first_[d]) - 1, -beyond, beyond);
      p[d] = {1, t, 0.5 * (3 * t * t - 1)};
    }
    Terms found;
    int term = 0;
    for (int sum = 0; sum <= degree; ++sum)  // lower degrees first
      for (int a = 0; a <= sum; ++a)
        for (int b = 0; a + b <= sum; ++b) found[term++] = p[0][a] * p[1][b] * p[2][sum - a - b];
    return found;
  }

 private:
  Grid grid_;
  std::array<int, 3> first_, last_{};
};

/// The dark end of the tissue in a box.
struct Dark {
  Terms place;
  double level, voxels;
};

std::vector<Dark> dark_ends(const Volume<float>& logs, const Mask& core, const Polynomials& at) {
  constexpr double box = 25, dark_share = 0.2, least_filled = 0.1;  // mm
  const Grid& grid = logs.grid;
  std::array<int, 3> width{};
  for (int d = 0; d < 3; ++d) width[d] = std::max(1, int(std::lround(box / grid.spacing[d])));
  const double enough = least_filled * width[0] * width[1] * width[2];
  std::vector<Dark> found;
  for (int k0 = 0; k0 < grid.size[2]; k0 += width[2]) {
    for (int j0 = 0; j0 < grid.size[1]; j0 += width[1]) {
      for (int i0 = 0; i0 < grid.size[0]; i0 += width[0]) {
        std::vector<float> values;
        Vec3 middle = Vec3::Zero();
        for (int k = k0; k < std::min(k0 + width[2], grid.size[2]); ++k) {
          for (int j = j0; j < std::min(j0 + width[1], grid.size[1]); ++j) {
            for (int i = i0; i < std::min(i0 + width[0], grid.size[0]); ++i) {
              if (!core.at(i, j, k)) continue;
              values.push_back(logs.at(i, j, k));
              middle += Vec3(i, j, k);
            }
          }
        }
        const double count = double(values.size());
        if (count < enough) continue;
        found.push_back(
            {at.at(middle / count), percentile(std::move(values), dark_share, 0), count});
      }
    }
  }
  return found;
}

/// The polynomial beneath the dark ends: what lies above it counts less the farther it lies, since
/// it holds gland, or fat that is not suppressed. The degree grows from pass to pass.
Terms beneath(const std::vector<Dark>& ends) {
  constexpr double above_by = 0.15, below_by = 0.4;
  constexpr int passes = 12;
  constexpr std::array<int, 3> terms_of_degree{1, 4, 10};
  Terms found = Terms::Zero();
  std::vector<float> levels;
  for (const Dark& one : ends) levels.push_back(float(one.level));
  found[0] = percentile(std::move(levels), 0.35, 0);
  for (int up_to = 1; up_to <= degree; ++up_to) {
    for (int pass = 0; pass < passes; ++pass) {
      Eigen::Matrix<double, terms, terms> normal = Eigen::Matrix<double, terms, terms>::Zero();
      Terms right = Terms::Zero();
      double sum = 0;
      for (const Dark& one : ends) {
        const double off = one.level - one.place.dot(found),
                     times = off / (off > 0 ? above_by : below_by);
        const double weight = one.voxels / ((1 + times * times) * (1 + times * times));
        normal += weight * one.place * one.place.transpose();
        right += weight * one.level * one.place;
        sum += weight;
      }
      // Few boxes do not determine all terms, and a steep coil is one of low degree.
      for (int n = 0; n < terms; ++n) {
        if (n > 0) normal(n, n) += (n < terms_of_degree[1] ? 1e-3 : 1e-2) * sum;
        if (n < terms_of_degree[std::size_t(up_to)]) continue;
        normal.row(n).setZero();
        normal.col(n).setZero();
        normal(n, n) = 1;
        right[n] = 0;
      }
      found = normal.ldlt().solve(right);
    }
  }
  return found;
}

}  // namespace

BiasField suppressed_level(const Volume<float>& scan, const Mask& allowed,
                           const Volume<float>& skin_distance) {
  constexpr float far_below = 0.6f, far_above = 0.35f;  // of the logarithm: no fat beyond
  constexpr int rounds = 2;
  const BiasSettings settings{.sigma = 12, .refined = true};
  const Grid& grid = scan.grid;
  Volume<float> logs(grid), level(grid);
  Mask core(grid);
  for (std::size_t n = 0; n < logs.voxels.size(); ++n) {
    core.voxels[n] =
        allowed.voxels[n] && -skin_distance.voxels[n] > settings.core && scan.voxels[n] > 0;
    if (core.voxels[n]) logs.voxels[n] = elementary::log(scan.voxels[n]);
  }
  const Polynomials polynomials(core);
  const std::vector<Dark> ends = dark_ends(logs, core, polynomials);
  if (ends.empty()) throw input_error("no tissue beneath the skin is in view");
  const Terms trend = beneath(ends);
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
        level.at(i, j, k) = float(trend.dot(polynomials.at(Vec3(i, j, k))));
  BiasField field;
  for (int round = 0; round < rounds; ++round) {
    // fat_bias() looks for the bright tissue: that is fat in one over the brightness.
    Volume<float> turned_over(grid);
    Mask fat(grid);
    for (std::size_t n = 0; n < logs.voxels.size(); ++n) {
      if (!(scan.voxels[n] > 0)) continue;
      turned_over.voxels[n] = elementary::exp(level.voxels[n]) / scan.voxels[n];
      const float off = logs.voxels[n] - level.voxels[n];
      fat.voxels[n] = core.voxels[n] && off > -far_below && off < far_above;
    }
    field = fat_bias(turned_over, fat, skin_distance, settings, nullptr);
    for (std::size_t n = 0; n < level.voxels.size(); ++n)
      level.voxels[n] -= field.log_bias.voxels[n];
  }
  field.log_bias = std::move(level);
  return field;
}

}  // namespace breast
