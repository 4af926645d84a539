// SPDX-License-Identifier: GPL-3.0-or-later
// Closest point on a Hermite sheet.
#pragma once

#include <vector>

#include "core/types.hpp"
#include "surface/hermite.hpp"

namespace breast {

struct SheetFoot {
  Vec2 st{0.5, 0.5};
  Vec3 x = Vec3::Zero();
  double distance = 0;  ///< mm
};

/// The local minimum of the distance reached from `start`, by Newton's method with the sheet's
/// second derivatives (Gauss–Newton where they are indefinite), bounds as an active set, and step
/// halving. It never increases the distance and never leaves [0,1]^2.
SheetFoot closest_from(const HermiteSheet& sheet, const Vec3& target, const Vec2& start);

/// Global closest points: seeds from a regular sample of the sheet, then closest_from.
class SheetLocator {
 public:
  /// `per_patch` samples along each side of a patch. The sheet must outlive the locator.
  explicit SheetLocator(const HermiteSheet& sheet, int per_patch = 4);
  SheetFoot closest(const Vec3& target) const;

 private:
  const HermiteSheet& sheet_;
  int columns_, rows_;
  std::vector<Vec3> sample_;
  Vec2 parameter(int i, int j) const {
    return {double(i) / (columns_ - 1), double(j) / (rows_ - 1)};
  }
};

}  // namespace breast
