#include "core/parallel.hpp"

#include <omp.h>

#include <algorithm>
#include <thread>

namespace breast {

namespace {
int& count() {
  static int value = std::max(1u, std::thread::hardware_concurrency());
  return value;
}
}  // namespace

void set_threads(int threads) {
  count() = threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  omp_set_num_threads(count());
}

int threads() { return count(); }

}  // namespace breast
