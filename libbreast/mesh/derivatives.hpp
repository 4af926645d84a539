// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a mesh's shape, as arrays beside it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct Derivatives {
  /// ∂points/∂parameter per node, by parameter: mm per relative change, degree or mm.
  std::map<std::string, std::vector<Vec3>> position;
  /// ∂(displacement of a landmark, mm)/∂(ln stiffness of the element), by landmark.
  std::map<std::string, std::vector<double>> influence;
};

}  // namespace breast
