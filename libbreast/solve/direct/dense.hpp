// SPDX-License-Identifier: GPL-3.0-or-later
// Dense operations on a front, in place and column-major; large ones are divided into tiles that
// OpenMP tasks share. The tiles do not depend on the number of threads, so neither does the result.
#pragma once

namespace breast::dense {

/// The first `columns` columns of a symmetric front are eliminated: `panel` (height × columns,
/// lower triangle) becomes L, and L₂₁L₂₁ᵀ is subtracted from `rest`, the (height − columns)² lower
/// triangle behind it. False at a pivot that is not positive. Call inside a parallel region.
bool eliminate(double* panel, int height, int columns, double* rest);

/// x ← L⁻¹x and y ← y − L₂₁x of one panel; and x ← L⁻ᵀ(x − L₂₁ᵀy).
void solve_down(const double* panel, int height, int columns, double* x, double* y);
void solve_up(const double* panel, int height, int columns, double* x, const double* y);

}  // namespace breast::dense
