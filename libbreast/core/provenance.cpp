// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/provenance.hpp"

#include <algorithm>

namespace breast {

namespace {
bool same(const HistoryEntry& a, const HistoryEntry& b) {
  const auto inputs_equal = [](const InputRecord& x, const InputRecord& y) {
    return x.name == y.name && x.sha256 == y.sha256;
  };
  return a.tool == b.tool && a.command == b.command && a.version == b.version &&
         std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(),
                    inputs_equal);
}
}  // namespace

History extend_history(const std::vector<const History*>& inputs, const HistoryEntry& entry) {
  History merged;
  for (const History* history : inputs) {
    for (const HistoryEntry& old : *history) {
      const bool known = std::any_of(merged.begin(), merged.end(),
                                     [&](const HistoryEntry& e) { return same(e, old); });
      if (!known) merged.push_back(old);
    }
  }
  merged.push_back(entry);
  return merged;
}

}  // namespace breast
