// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/slice_interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace breast {

namespace {

constexpr double far = 25;  // mm; distances beyond do not matter between neighbouring slices

/// Squared distance along one line of samples `step` apart: lower envelope of parabolas
/// (Felzenszwalb and Huttenlocher 2012). In: squared distance so far (large where unknown).
void line_distance(std::vector<double>& f, double step, std::vector<int>& parabola,
                   std::vector<double>& boundary, std::vector<double>& out) {
  const int n = int(f.size());
  int k = 0;
  parabola[0] = 0;
  boundary[0] = -std::numeric_limits<double>::infinity();
  boundary[1] = std::numeric_limits<double>::infinity();
  const double s2 = step * step;
  for (int q = 1; q < n; ++q) {
    const auto meet = [&](int p) {
      return (f[q] - f[p] + s2 * (double(q) * q - double(p) * p)) / (2 * s2 * (q - p));
    };
    double at = meet(parabola[k]);
    while (at <= boundary[k]) at = meet(parabola[--k]);
    parabola[++k] = q;
    boundary[k] = at;
    boundary[k + 1] = std::numeric_limits<double>::infinity();
  }
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (boundary[k + 1] < q) ++k;
    const double d = q - parabola[k];
    out[q] = f[parabola[k]] + s2 * d * d;
  }
  f.swap(out);
}

/// One slice: two axes of the volume with a third fixed.
struct Slice {
  std::size_t start, stride_a, stride_b;
  int count_a, count_b;
  double step_a, step_b;
};

/// Distance (mm, at most `far`) of every sample to the nearest one with (value > 1/2) == inside.
std::vector<double> distance_to(const std::vector<float>& voxels, const Slice& s, bool inside) {
  const double unknown = 1e12;
  std::vector<double> d(std::size_t(s.count_a) * s.count_b);
  const int most = std::max(s.count_a, s.count_b);
  std::vector<int> parabola(most);
  std::vector<double> boundary(most + 1);
  std::vector<double> line(s.count_a), out(s.count_a);
  for (int b = 0; b < s.count_b; ++b) {
    for (int a = 0; a < s.count_a; ++a)
      line[a] = (voxels[s.start + a * s.stride_a + b * s.stride_b] > 0.5f) == inside ? 0 : unknown;
    line_distance(line, s.step_a, parabola, boundary, out);
    std::copy(line.begin(), line.end(), d.begin() + std::ptrdiff_t(b) * s.count_a);
  }
  line.resize(s.count_b), out.resize(s.count_b);
  for (int a = 0; a < s.count_a; ++a) {
    for (int b = 0; b < s.count_b; ++b) line[b] = d[std::size_t(b) * s.count_a + a];
    line_distance(line, s.step_b, parabola, boundary, out);
    for (int b = 0; b < s.count_b; ++b)
      d[std::size_t(b) * s.count_a + a] = std::min(far, std::sqrt(line[b]));
  }
  return d;
}

/// Positive inside; zero halfway between the outermost sample inside and the first outside.
std::vector<double> signed_distance(const std::vector<float>& voxels, const Slice& s) {
  std::vector<double> d = distance_to(voxels, s, false);
  const std::vector<double> outside = distance_to(voxels, s, true);
  const double half = 0.25 * (s.step_a + s.step_b);
  for (std::size_t n = 0; n < d.size(); ++n) d[n] = d[n] > 0 ? d[n] - half : half - outside[n];
  return d;
}

}  // namespace

Volume<float> fill_between_slices(const Volume<float>& mask) {
  const Grid& g = mask.grid;
  int axis = 0;
  for (int c = 1; c < 3; ++c)
    if (g.spacing[c] > g.spacing[axis]) axis = c;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  const int parts =
      std::clamp(int(std::lround(g.spacing[axis] / std::max(g.spacing[a], g.spacing[b]))), 1, 6);
  if (parts == 1 || g.size[axis] < 2) return mask;

  Grid fine = g;
  fine.size[axis] = (g.size[axis] - 1) * parts + 1;
  fine.spacing[axis] = g.spacing[axis] / parts;
  Volume<float> filled(fine);
  const auto slice = [&](const Grid& grid, int n) {
    const std::size_t stride[3] = {1, std::size_t(grid.size[0]),
                                   std::size_t(grid.size[0]) * grid.size[1]};
    return Slice{n * stride[axis], stride[a],       stride[b],      grid.size[a],
                 grid.size[b],     grid.spacing[a], grid.spacing[b]};
  };
  std::vector<std::vector<double>> distance(g.size[axis]);
#pragma omp parallel for schedule(dynamic)
  for (int n = 0; n < g.size[axis]; ++n) distance[n] = signed_distance(mask.voxels, slice(g, n));
  const double soft = std::max(g.spacing[a], g.spacing[b]);  // partial volume over one sample
#pragma omp parallel for schedule(static)
  for (int n = 0; n < fine.size[axis]; ++n) {
    const int below = std::min(n / parts, g.size[axis] - 2);
    const double part = double(n - below * parts) / parts;
    const Slice s = slice(fine, n);
    for (int j = 0; j < s.count_b; ++j)
      for (int i = 0; i < s.count_a; ++i) {
        const std::size_t m = std::size_t(j) * s.count_a + i;
        const double d = (1 - part) * distance[below][m] + part * distance[below + 1][m];
        filled.voxels[s.start + i * s.stride_a + j * s.stride_b] =
            float(std::clamp(0.5 + d / soft, 0.0, 1.0));
      }
  }
  return filled;
}

}  // namespace breast
