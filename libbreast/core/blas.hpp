// SPDX-License-Identifier: GPL-3.0-or-later
// Configuration of the BLAS used for factorisations: its threads and its processor-specific
// kernels.
#pragma once

#include <string>

namespace breast {

/// Sets OpenBLAS to one thread. Results must not depend on the number of threads, but the order of
/// OpenBLAS's sums does; moreover, fronts are shared among OpenMP threads, and two pools of
/// spinning threads would compete. OpenBLAS 0.3.21 does not recognise processors newer than itself
/// and falls back to kernels of 2004 (SSE3), which are five times slower: in that case, if the
/// processor has AVX2 or AVX-512, its table of kernels is selected again. OPENBLAS_CORETYPE set by
/// the user takes precedence. Call this before the first use of BLAS; later calls have no cost.
void prepare_blas();

/// Name of the BLAS for reports: "OpenBLAS SkylakeX" or "reference BLAS".
std::string blas_name();

}  // namespace breast
