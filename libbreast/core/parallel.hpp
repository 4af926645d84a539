// Threads: one number for the whole process, set once by the tool (OpenMP follows it; BLAS keeps to
// one, see blas.hpp).
#pragma once

namespace breast {

/// Below this many cells or nodes a loop of a few microseconds is over before a second thread wakes.
constexpr int worth_threads = 20000;

/// 0 means all cores. Also tells OpenMP.
void set_threads(int threads);
int threads();

}  // namespace breast
