// SPDX-License-Identifier: GPL-3.0-or-later
// The registry of supports: a support is one file of this folder and one line here.
#pragma once

#include "mechanics/supports/support.hpp"

// clang-format off
#define BREAST_SUPPORTS(SUPPORT) \
  SUPPORT(held) \
  SUPPORT(slide) \
  SUPPORT(wall_springs) \
  SUPPORT(free) \
  SUPPORT(fixed) \
  SUPPORT(roller) \
  SUPPORT(cut_springs) \
  SUPPORT(stiffening) \
  SUPPORT(tissue)

// clang-format on

namespace breast::supports {

#define BREAST_DECLARE_SUPPORT(NAME) const SupportKind& NAME();
BREAST_SUPPORTS(BREAST_DECLARE_SUPPORT)
#undef BREAST_DECLARE_SUPPORT

}  // namespace breast::supports
