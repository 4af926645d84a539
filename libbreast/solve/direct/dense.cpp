// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/direct/dense.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
            const double*, const int*, const double*, const int*, const double*, double*,
            const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*,
            const int*, const double*, double*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*,
            const double*, const double*, const int*, double*, const int*);
void dgemv_(const char*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
void dtrsv_(const char*, const char*, const char*, const int*, const double*, const int*, double*,
            const int*);
}

namespace breast::dense {

namespace {

constexpr int panel_width = 96, tile = 256, smallest = 24;
constexpr double worth_tasks = 2e7;  // flops: a millisecond
constexpr double one = 1, minus = -1;
constexpr int unit = 1;

// C −= A Bᵀ with inner dimension k; on the diagonal (A = B) only the lower triangle.
void subtract(const double* a, const double* b, int ld, int m, int n, int k, double* c, int ldc) {
  if (m <= 0 || n <= 0 || k <= 0) return;
  dgemm_("N", "T", &m, &n, &k, &minus, a, &ld, b, &ld, &one, c, &ldc);
}
void subtract_lower(const double* a, int ld, int n, int k, double* c, int ldc) {
  if (n <= 0 || k <= 0) return;
  dsyrk_("L", "N", &n, &k, &minus, a, &ld, &one, c, &ldc);
}

// A ← A L⁻ᵀ, A m × n.
void divide(const double* l, int ld, int m, int n, double* a) {
  if (m > 0) dtrsm_("R", "L", "T", "N", &m, &n, &one, l, &ld, a, &ld);
}

bool factor_smallest(double* a, int ld, int n) {
  for (int j = 0; j < n; ++j) {
    double* column = a + long(j) * ld;
    if (!(column[j] > 0) || !std::isfinite(column[j])) return false;
    const double pivot = std::sqrt(column[j]), inverse = 1 / pivot;
    column[j] = pivot;
    for (int i = j + 1; i < n; ++i) column[i] *= inverse;
    for (int k = j + 1; k < n; ++k) {
      double* other = a + long(k) * ld;
      const double factor = column[k];
      for (int i = k; i < n; ++i) other[i] -= factor * column[i];
    }
  }
  return true;
}

// Cholesky of a diagonal block by halves.
bool factor_block(double* a, int ld, int n) {
  if (n <= smallest) return factor_smallest(a, ld, n);
  const int half = n / 2, rest = n - half;
  double *below = a + half, *corner = a + long(half) * ld + half;
  if (!factor_block(a, ld, half)) return false;
  divide(a, ld, rest, half, below);
  subtract_lower(below, ld, rest, half, corner, ld);
  return factor_block(corner, ld, rest);
}

// Lower triangle of C (n × n) −= A Aᵀ over the first `wide` columns of C, A being n × k, by tiles.
void subtract_tiles(const double* a, int ld, int n, int wide, int k, double* c, int ldc) {
  if (double(n) * wide * k < worth_tasks) {
    subtract_lower(a, ld, wide, k, c, ldc);
    subtract(a + wide, a, ld, n - wide, wide, k, c + wide, ldc);
    return;
  }
  for (int j = 0; j < wide; j += tile) {
    const int width = std::min(tile, wide - j);
    for (int i = j; i < n; i += tile) {
      const int height = std::min(tile, (i == j ? j + width : n) - i);
      // The remaining rows of the tile beside a narrow last column of tiles.
      const int more = std::min(tile, n - i) - width;
      double* to = c + long(j) * ldc + i;
#pragma omp task default(none) firstprivate(a, ld, i, j, height, width, more, k, to, ldc)
      {
        if (i == j) {
          subtract_lower(a + j, ld, width, k, to, ldc);
          subtract(a + i + width, a + j, ld, more, width, k, to + width, ldc);
        } else {
          subtract(a + i, a + j, ld, height, width, k, to, ldc);
        }
      }
    }
  }
#pragma omp taskwait
}

void divide_tiles(const double* l, int ld, int m, int n, double* a) {
  if (double(m) * n * n < worth_tasks) {
    divide(l, ld, m, n, a);
    return;
  }
  for (int i = 0; i < m; i += tile) {
    const int height = std::min(tile, m - i);
#pragma omp task default(none) firstprivate(l, ld, height, n, a, i)
    divide(l, ld, height, n, a + i);
  }
#pragma omp taskwait
}

}  // namespace

bool eliminate(double* panel, int height, int columns, double* rest) {
  for (int k = 0; k < columns; k += panel_width) {
    const int width = std::min(panel_width, columns - k), below = height - k - width;
    double* block = panel + long(k) * height + k;
    if (!factor_block(block, height, width)) return false;
    divide_tiles(block, height, below, width, block + width);
    subtract_tiles(block + width, height, below, columns - k - width, width,
                   block + long(width) * height + width, height);
  }
  subtract_tiles(panel + columns, height, height - columns, height - columns, columns, rest,
                 std::max(1, height - columns));
  return true;
}

void solve_down(const double* panel, int height, int columns, double* x, double* y) {
  dtrsv_("L", "N", "N", &columns, panel, &height, x, &unit);
  const int below = height - columns;
  if (below > 0) {
    dgemv_("N", &below, &columns, &minus, panel + columns, &height, x, &unit, &one, y, &unit);
  }
}

void solve_up(const double* panel, int height, int columns, double* x, const double* y) {
  const int below = height - columns;
  if (below > 0) {
    dgemv_("T", &below, &columns, &minus, panel + columns, &height, y, &unit, &one, x, &unit);
  }
  dtrsv_("L", "T", "N", &columns, panel, &height, x, &unit);
}

}  // namespace breast::dense
