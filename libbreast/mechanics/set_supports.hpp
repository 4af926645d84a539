// SPDX-License-Identifier: GPL-3.0-or-later
// Use of the supports of wall and cut with which a material set was identified.
#pragma once

#include "mechanics/options.hpp"

namespace breast {

/// If the material set of `options` has supports, the breast slides on the chest wall against them.
/// The cut then has springs; it may carry the weight of the tissue beyond and be attached to the
/// sternum. Otherwise wall and cut are unchanged.
inline void take_supports_of_set(MechanicsOptions& options) {
  const MaterialSet& set = options.materials;
  if (set.wall_support) options.wall = WallOption(WallKind::slide, {0, *set.wall_support});
  const Cut cut = set.tissue_beyond ? Cut::tissue : Cut::spring;
  if (set.cut_support) options.cut = CutOption(cut, *set.cut_support, set.sternum_support);
}

}  // namespace breast
