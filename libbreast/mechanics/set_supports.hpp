// SPDX-License-Identifier: GPL-3.0-or-later
// Use of the supports of wall and cut with which a material set was identified.
#pragma once

#include "mechanics/options.hpp"

namespace breast {

/// If the material set of `options` has supports, the breast slides on the chest wall against them.
/// The cut then has springs; it may carry the weight of the tissue beyond and be attached to the
/// sternum; it is free if both stiffnesses are 0. Where the set has no support, wall or cut is
/// unchanged.
inline void take_supports_of_set(MechanicsOptions& options) {
  const MaterialSet& set = options.materials;
  if (set.wall_support) options.wall = WallOption(WallKind::slide, {0, *set.wall_support});
  if (!set.cut_support) return;
  const Cut kind = set.tissue_beyond ? Cut::tissue : Cut::spring;
  const bool attached = set.sternum_support.value_or(0) > 0;
  options.cut =
      *set.cut_support > 0 || attached
          ? CutOption(kind, *set.cut_support, attached ? set.sternum_support : std::nullopt)
          : CutOption(Cut::free);
}

}  // namespace breast
