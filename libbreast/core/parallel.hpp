// SPDX-License-Identifier: GPL-3.0-or-later
// The number of threads of the process, set once by the tool (OpenMP uses it; BLAS uses one thread,
// see blas.hpp).
#pragma once

namespace breast {

/// Below this many cells or nodes a loop of a few microseconds is over
/// before a second thread wakes.
constexpr int worth_threads = 20000;

/// 0 means all cores. Also tells OpenMP.
void set_threads(int threads);
int threads();

/// Starts the program anew (same process, same arguments) with threads that fall asleep soon when
/// they wait, unless the environment says how they should wait. Call before there is anything to
/// lose; returns when nothing has to change, or cannot. OpenMP's own threads spin for milliseconds:
/// beside other work they take the core from the thread they wait for (measured: forward 6.7 s
/// instead of 1.0), on an idle machine they cost a quarter of the CPU time. libgomp reads the
/// setting while it is loaded; there is no call for it.
void sleep_when_waiting(char** argv);

}  // namespace breast
