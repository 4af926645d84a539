// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's rib cage as a smooth surface on which its breasts slide: the torso's superelliptic
// sections without the groove over the sternum.
#pragma once

#include "phantom/parameters.hpp"
#include "surface/level_surface.hpp"

namespace breast {

/// φ = (f − 1) half_depth, where f² is the superellipse of TorsoParameters; its gradient is 1 at
/// the front. Twice continuously differentiable for powers of 2 and above; not defined near the
/// centre of a section.
class RibSurface final : public LevelSurface {
 public:
  /// Throws Error (input) for a power below 2.
  explicit RibSurface(const TorsoParameters& torso);
  std::optional<Level> at(const Vec3& x) const override;

 private:
  TorsoParameters torso_;
};

}  // namespace breast
