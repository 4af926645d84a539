// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/grid/grid_ops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/elementary.hpp"

namespace breast {

Volume<float> in_patient_order(Volume<float> volume) {
  const Grid& from = volume.grid;
  // Of the six permutations the one whose directions lie closest to x, y, z.
  std::array<int, 3> axis{0, 1, 2}, best = axis;
  double best_score = -1;
  do {
    double score = 0;
    for (int d = 0; d < 3; ++d) score += std::abs(from.direction(d, axis[d]));
    if (score > best_score + 1e-9) {
      best_score = score;
      best = axis;
    }
  } while (std::next_permutation(axis.begin(), axis.end()));

  Volume<float> out;
  std::array<bool, 3> flip{};
  Vec3 corner(0, 0, 0);
  for (int d = 0; d < 3; ++d) {
    flip[d] = from.direction(d, best[d]) < 0;
    out.grid.size[d] = from.size[best[d]];
    out.grid.spacing[d] = from.spacing[best[d]];
    out.grid.direction.col(d) = (flip[d] ? -1.0 : 1.0) * from.direction.col(best[d]);
    if (flip[d]) corner[best[d]] = from.size[best[d]] - 1;
  }
  if (best == std::array{0, 1, 2} && flip == std::array{false, false, false}) return volume;
  out.grid.origin = from.to_patient(corner);
  out.voxels.resize(volume.voxels.size());
  for (int k = 0; k < out.grid.size[2]; ++k) {
    for (int j = 0; j < out.grid.size[1]; ++j) {
      for (int i = 0; i < out.grid.size[0]; ++i) {
        const std::array<int, 3> index{i, j, k};
        std::array<int, 3> source{};
        for (int d = 0; d < 3; ++d) {
          source[best[d]] = flip[d] ? out.grid.size[d] - 1 - index[d] : index[d];
        }
        out.at(i, j, k) = volume.at(source[0], source[1], source[2]);
      }
    }
  }
  return out;
}

Grid coarsened_grid(const Grid& grid, const std::array<int, 3>& factor) {
  Grid coarse = grid;
  Vec3 shift;
  for (int d = 0; d < 3; ++d) {
    coarse.size[d] = (grid.size[d] + factor[d] - 1) / factor[d];
    coarse.spacing[d] = grid.spacing[d] * factor[d];
    shift[d] = 0.5 * (factor[d] - 1);
  }
  coarse.origin = grid.to_patient(shift);
  return coarse;
}

Volume<float> coarsened(const Volume<float>& volume, const std::array<int, 3>& factor) {
  Volume<float> out(coarsened_grid(volume.grid, factor));
  const auto& fine = volume.grid.size;
#pragma omp parallel for
  for (int k = 0; k < out.grid.size[2]; ++k) {
    for (int j = 0; j < out.grid.size[1]; ++j) {
      for (int i = 0; i < out.grid.size[0]; ++i) {
        double sum = 0;
        int count = 0;
        for (int c = k * factor[2]; c < std::min((k + 1) * factor[2], fine[2]); ++c) {
          for (int b = j * factor[1]; b < std::min((j + 1) * factor[1], fine[1]); ++b) {
            for (int a = i * factor[0]; a < std::min((i + 1) * factor[0], fine[0]); ++a) {
              sum += volume.at(a, b, c);
              ++count;
            }
          }
        }
        out.at(i, j, k) = static_cast<float>(sum / count);
      }
    }
  }
  return out;
}

Volume<float> resampled(const Volume<float>& coarse, const Grid& fine) {
  Volume<float> out(fine);
  // Parallel axes: index maps are separable, so positions and weights are made once per axis.
  const Vec3 first = coarse.grid.to_index(fine.origin);
  std::array<std::vector<int>, 3> low;
  std::array<std::vector<float>, 3> weight;
  for (int d = 0; d < 3; ++d) {
    const int last = coarse.grid.size[d] - 1;
    for (int n = 0; n < fine.size[d]; ++n) {
      const double x =
          std::clamp(first[d] + n * fine.spacing[d] / coarse.grid.spacing[d], 0.0, double(last));
      const int cell = std::min(int(x), std::max(last - 1, 0));
      low[d].push_back(cell);
      weight[d].push_back(float(x - cell));
    }
  }
  const auto& n = coarse.grid.size;
#pragma omp parallel for
  for (int k = 0; k < fine.size[2]; ++k) {
    const int c0 = low[2][k], c1 = std::min(c0 + 1, n[2] - 1);
    const float wc = weight[2][k];
    for (int j = 0; j < fine.size[1]; ++j) {
      const int b0 = low[1][j], b1 = std::min(b0 + 1, n[1] - 1);
      const float wb = weight[1][j];
      const float* r00 = &coarse.at(0, b0, c0);
      const float* r10 = &coarse.at(0, b1, c0);
      const float* r01 = &coarse.at(0, b0, c1);
      const float* r11 = &coarse.at(0, b1, c1);
      for (int i = 0; i < fine.size[0]; ++i) {
        const int a0 = low[0][i], a1 = std::min(a0 + 1, n[0] - 1);
        const float wa = weight[0][i];
        const auto along = [&](const float* row) { return row[a0] + wa * (row[a1] - row[a0]); };
        const float near = along(r00) + wb * (along(r10) - along(r00));
        const float far = along(r01) + wb * (along(r11) - along(r01));
        out.at(i, j, k) = near + wc * (far - near);
      }
    }
  }
  return out;
}

Grid rolled_grid(const Grid& grid, double angle) {
  Mat3 turn = Mat3::Identity();
  turn(0, 0) = turn(1, 1) = elementary::cos(angle);
  turn(1, 0) = elementary::sin(angle);
  turn(0, 1) = -elementary::sin(angle);
  Grid wide = grid;
  wide.direction = grid.direction * turn;
  const auto half = [&](int d) { return 0.5 * (grid.size[d] - 1) * grid.spacing[d]; };
  for (int d = 0; d < 2; ++d) {
    const double reach = half(d) * std::abs(turn(0, 0)) + half(1 - d) * std::abs(turn(1, 0));
    // The least that holds the field, with its middle voxel or gap in the place of the old one.
    wide.size[d] += 2 * int(std::ceil((reach - half(d)) / grid.spacing[d]));
  }
  const auto middle = [](const Grid& g) -> Vec3 {
    return 0.5 * Vec3(g.size[0] - 1, g.size[1] - 1, g.size[2] - 1);
  };
  wide.origin += grid.to_patient(middle(grid)) - wide.to_patient(middle(wide));
  return wide;
}

Volume<float> on_rolled_grid(const Volume<float>& volume, const Grid& grid) {
  Volume<float> out(grid);
  const auto& size = volume.grid.size;
  const Vec3 first = volume.grid.to_index(grid.origin);
  const Vec3 across = volume.grid.to_index(grid.to_patient(Vec3(1, 0, 0))) - first,
             along = volume.grid.to_index(grid.to_patient(Vec3(0, 1, 0))) - first;
#pragma omp parallel for
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double x = std::clamp(first[0] + i * across[0] + j * along[0], 0.0, size[0] - 1.0),
                     y = std::clamp(first[1] + i * across[1] + j * along[1], 0.0, size[1] - 1.0);
        const int a = std::min(int(x), std::max(size[0] - 2, 0)), c = std::min(a + 1, size[0] - 1),
                  b = std::min(int(y), std::max(size[1] - 2, 0)), d = std::min(b + 1, size[1] - 1);
        const double near =
                         volume.at(a, b, k) + (x - a) * (volume.at(c, b, k) - volume.at(a, b, k)),
                     far = volume.at(a, d, k) + (x - a) * (volume.at(c, d, k) - volume.at(a, d, k));
        out.at(i, j, k) = float(near + (y - b) * (far - near));
      }
    }
  }
  return out;
}

}  // namespace breast
