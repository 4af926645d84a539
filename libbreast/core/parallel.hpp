// SPDX-License-Identifier: GPL-3.0-or-later
// The number of threads of the process, set once by the tool (OpenMP uses it; BLAS uses one thread,
// see blas.hpp).
#pragma once

namespace breast {

/// Number of cells or nodes below which a loop takes only a few microseconds and ends before a
/// second thread wakes.
constexpr int worth_threads = 20000;

/// Sets the number of threads, also for OpenMP; 0 means all cores.
void set_threads(int threads);
int threads();

/// Restarts the program (same process, same arguments) with threads that sleep soon when they wait,
/// unless the environment states how they should wait. Call this at the start of the program; it
/// returns if nothing has to be changed, or cannot be. OpenMP's own threads spin for milliseconds:
/// beside other work they take the core from the thread they wait for (measured: forward 6.7 s
/// instead of 1.0), on an idle machine they cost a quarter of the CPU time. libgomp reads the
/// setting while it is loaded; there is no call for it.
void sleep_when_waiting(char** argv);

}  // namespace breast
