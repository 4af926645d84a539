// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/blas.hpp"

#include <cstdlib>
#include <mutex>
#include <string_view>

extern "C" {
// Weak: present only when the BLAS is OpenBLAS, the gotoblas ones only with run-time kernels.
void openblas_set_num_threads(int) __attribute__((weak));
char* openblas_get_corename() __attribute__((weak));
void gotoblas_dynamic_init() __attribute__((weak));
void gotoblas_dynamic_quit() __attribute__((weak));
}

namespace breast {

namespace {

const char* better_kernels() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq")) {
    return "SkylakeX";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

void choose_kernels() {
  if (openblas_get_corename == nullptr || gotoblas_dynamic_init == nullptr ||
      gotoblas_dynamic_quit == nullptr || std::getenv("OPENBLAS_CORETYPE") != nullptr) {
    return;
  }
  const std::string_view chosen = openblas_get_corename();
  const char* better = better_kernels();
  if (better == nullptr ||
      (chosen != "Prescott" && chosen != "Core2" && chosen != "Barcelona" && chosen != "Generic")) {
    return;
  }
  setenv("OPENBLAS_CORETYPE", better, 1);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
}

}  // namespace

void prepare_blas() {
  static std::once_flag once;
  std::call_once(once, choose_kernels);
  if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

std::string blas_name() {
  if (openblas_get_corename == nullptr) return "reference BLAS";
  return std::string("OpenBLAS ") + openblas_get_corename();
}

}  // namespace breast
