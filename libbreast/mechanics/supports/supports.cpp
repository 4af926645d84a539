// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/supports/supports.hpp"

namespace breast {

const std::vector<const SupportKind*>& support_kinds() {
#define BREAST_LIST_SUPPORT(NAME) &supports::NAME(),
  static const std::vector<const SupportKind*> all{BREAST_SUPPORTS(BREAST_LIST_SUPPORT)};
#undef BREAST_LIST_SUPPORT
  return all;
}

}  // namespace breast
