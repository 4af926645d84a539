// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/laws/laws.hpp"

namespace breast {

const std::vector<const LawKind*>& law_kinds() {
#define BREAST_LIST_LAW(NAME) &laws::NAME(),
  static const std::vector<const LawKind*> all{BREAST_LAWS(BREAST_LIST_LAW)};
#undef BREAST_LIST_LAW
  return all;
}

}  // namespace breast
