// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth surface given as a level set of a function, such as the chest wall on which a breast
// slides.
#pragma once

#include <optional>

#include "core/types.hpp"

namespace breast {

/// A function φ at a point: its value (mm, zero on the surface), gradient (about 1) and second
/// derivatives (1/mm).
struct Level {
  double value = 0;
  Vec3 gradient{0, 0, 0};
  Mat3 hessian = Mat3::Zero();
};

class LevelSurface {
 public:
  virtual ~LevelSurface() = default;
  /// φ at a point, twice continuously differentiable wherever it is defined; no value elsewhere.
  virtual std::optional<Level> at(const Vec3& x) const = 0;
};

}  // namespace breast
