// SPDX-License-Identifier: GPL-3.0-or-later
// The registry of laws: a law is one file of this folder and one line here. The order is that of the
// columns of material tables.
#pragma once

#include "material/law.hpp"

// clang-format off
#define BREAST_LAWS(LAW) \
  LAW(polynomial) \
  LAW(neo_hookean) \
  LAW(mooney_rivlin) \
  LAW(yeoh) \
  LAW(gent) \
  LAW(exponential)

// clang-format on

namespace breast::laws {

#define BREAST_DECLARE_LAW(NAME) const LawKind& NAME();
BREAST_LAWS(BREAST_DECLARE_LAW)
#undef BREAST_DECLARE_LAW

}  // namespace breast::laws
