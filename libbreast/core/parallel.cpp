// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/parallel.hpp"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace breast {

namespace {
int& count() {
  static int value = std::max(1u, std::thread::hardware_concurrency());
  return value;
}
}  // namespace

void set_threads(int threads) {
  count() =
      threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  omp_set_num_threads(count());
}

int threads() {
  return count();
}

void sleep_when_waiting(char** argv) {
  constexpr const char* spins = "GOMP_SPINCOUNT";
  if (std::getenv(spins) != nullptr || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  // A few microseconds: about what it takes to wake a thread.
  if (setenv(spins, "1000", 0) == 0) execv("/proc/self/exe", argv);
}

}  // namespace breast
