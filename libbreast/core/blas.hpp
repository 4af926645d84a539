// SPDX-License-Identifier: GPL-3.0-or-later
// Configuration of the BLAS used for factorisations: its threads and its processor-specific
// kernels.
#pragma once

#include <string>

namespace breast {

/// Sets OpenBLAS to one thread: its products sum in an order that follows their number, and what a
/// tool finds must not; fronts are shared among OpenMP threads besides, and two pools of threads
/// that spin while they wait get into each other's way. OpenBLAS 0.3.21 does not know processors
/// newer than itself and falls back to kernels of 2004 (SSE3), five times slower: when that
/// happened and the processor has AVX2 or AVX-512, its table of kernels is chosen again.
/// OPENBLAS_CORETYPE set by the user wins. Call before the first BLAS use; later calls are free.
void prepare_blas();

/// "OpenBLAS SkylakeX" or "reference BLAS": for reports.
std::string blas_name();

}  // namespace breast
