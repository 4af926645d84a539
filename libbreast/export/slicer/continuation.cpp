// SPDX-License-Identifier: GPL-3.0-or-later
// Extrapolation of values from some grid points to all others, nearly harmonic, by nested
// iteration. Coarse grids carry the values far, and a few sweeps of Gauss-Seidel on each grid
// smooth the result of the next coarser one.
#include <algorithm>
#include <cmath>

#include "export/slicer/field.hpp"

namespace breast {

namespace {

struct GridLevel {
  std::array<int, 3> size;
  Vec3 spacing;
  std::vector<std::array<float, 3>> value;
  std::vector<char> known;

  std::size_t at(int i, int j, int k) const {
    return (std::size_t(k) * std::size_t(size[1]) + std::size_t(j)) * std::size_t(size[0]) +
           std::size_t(i);
  }
};

// The number of points along each axis that become one: two on dense axes, one along an axis that
// is already as coarse.
std::array<int, 3> merged(const GridLevel& fine) {
  std::array<int, 3> factor{};
  for (std::size_t d = 0; d < 3; ++d) {
    const bool dense = fine.spacing[int(d)] < 1.5 * fine.spacing.minCoeff();
    factor[d] = dense && fine.size[d] > 2 ? 2 : 1;
  }
  return factor;
}

GridLevel coarser(const GridLevel& fine, const std::array<int, 3>& factor) {
  GridLevel coarse{{}, fine.spacing, {}, {}};
  for (std::size_t d = 0; d < 3; ++d) {
    coarse.size[d] = (fine.size[d] + factor[d] - 1) / factor[d];
    coarse.spacing[int(d)] *= factor[d];
  }
  const std::size_t points =
      std::size_t(coarse.size[0]) * std::size_t(coarse.size[1]) * std::size_t(coarse.size[2]);
  coarse.value.assign(points, {0, 0, 0});
  coarse.known.assign(points, 0);
  std::vector<float> count(points, 0);
  for (int k = 0; k < fine.size[2]; ++k) {
    for (int j = 0; j < fine.size[1]; ++j) {
      for (int i = 0; i < fine.size[0]; ++i) {
        const std::size_t from = fine.at(i, j, k);
        if (!fine.known[from]) continue;
        const std::size_t to = coarse.at(i / factor[0], j / factor[1], k / factor[2]);
        for (std::size_t d = 0; d < 3; ++d) coarse.value[to][d] += fine.value[from][d];
        count[to] += 1;
      }
    }
  }
  for (std::size_t n = 0; n < points; ++n) {
    coarse.known[n] = count[n] > 0;
    for (float& v : coarse.value[n]) v = count[n] > 0 ? v / count[n] : 0;
  }
  return coarse;
}

void prolong(const GridLevel& coarse, const std::array<int, 3>& factor, GridLevel& fine) {
  for (int k = 0; k < fine.size[2]; ++k) {
    for (int j = 0; j < fine.size[1]; ++j) {
      for (int i = 0; i < fine.size[0]; ++i) {
        const std::size_t to = fine.at(i, j, k);
        if (!fine.known[to])
          fine.value[to] = coarse.value[coarse.at(i / factor[0], j / factor[1], k / factor[2])];
      }
    }
  }
}

// The mean of the six neighbours, weighted by 1/h²; there are none beyond the border, where the
// flux is zero.
void relax(GridLevel& level, int i, int j, int k) {
  const std::array<int, 3> place{i, j, k};
  std::array<float, 3> sum{0, 0, 0};
  float weights = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const float weight = float(1 / (level.spacing[int(d)] * level.spacing[int(d)]));
    for (const int step : {-1, 1}) {
      std::array<int, 3> beside = place;
      beside[d] += step;
      if (beside[d] < 0 || beside[d] >= level.size[d]) continue;
      const auto& value = level.value[level.at(beside[0], beside[1], beside[2])];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * value[c];
      weights += weight;
    }
  }
  if (weights == 0) return;
  for (std::size_t c = 0; c < 3; ++c) level.value[level.at(i, j, k)][c] = sum[c] / weights;
}

// Points of one colour of a chessboard pattern do not depend on each other, so that the values do
// not depend on the number of threads.
void sweep(GridLevel& level, int colour) {
#pragma omp parallel for schedule(static)
  for (int k = 0; k < level.size[2]; ++k) {
    for (int j = 0; j < level.size[1]; ++j) {
      for (int i = (j + k + colour) % 2; i < level.size[0]; i += 2) {
        if (!level.known[level.at(i, j, k)]) relax(level, i, j, k);
      }
    }
  }
}

void solve(GridLevel& level) {
  constexpr int sweeps = 12;
  const std::array<int, 3> factor = merged(level);
  const bool coarsest = level.size[0] <= 4 && level.size[1] <= 4 && level.size[2] <= 4;
  if (!coarsest && (factor[0] > 1 || factor[1] > 1 || factor[2] > 1)) {
    GridLevel coarse = coarser(level, factor);
    solve(coarse);
    prolong(coarse, factor, level);
  }
  for (int n = 0; n < (coarsest ? 100 : sweeps); ++n) {
    sweep(level, 0);
    sweep(level, 1);
  }
}

}  // namespace

void continue_field(DisplacementField& field) {
  GridLevel level{field.grid.size, field.grid.spacing, std::move(field.vectors), {}};
  level.known.resize(field.part.size());
  std::transform(field.part.begin(), field.part.end(), level.known.begin(),
                 [](FieldPart part) { return part != FieldPart::continued; });
  solve(level);
  for (std::size_t n = 0; n < level.value.size(); ++n) {
    if (level.known[n]) continue;
    for (float& v : level.value[n])
      v = std::round(v * 1024) / 1024;  // more digits would only enlarge the file
  }
  field.vectors = std::move(level.value);
}

}  // namespace breast
