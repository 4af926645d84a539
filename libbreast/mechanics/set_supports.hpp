// SPDX-License-Identifier: GPL-3.0-or-later
// The supports of wall and cut with which a material set was found.
#pragma once

#include "mechanics/options.hpp"

namespace breast {

/// Where the set of `options` has a support, the breast slides on its wall against it, and the cut
/// has springs; elsewhere wall and cut stay as they are.
inline void take_supports_of_set(MechanicsOptions& options) {
  const MaterialSet& set = options.materials;
  if (set.wall_support) options.wall = WallOption(WallKind::slide, {0, *set.wall_support});
  if (set.cut_support) options.cut = CutOption(Cut::spring, *set.cut_support);
}

}  // namespace breast
