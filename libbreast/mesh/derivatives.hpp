// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a mesh's shape with respect to parameters, as arrays on the mesh.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct Derivatives {
  /// ∂points/∂parameter per node, for each parameter: mm per unit of the parameter, which is a relative
  /// change, a degree or a mm.
  std::map<std::string, std::vector<Vec3>> position;
  /// ∂(displacement of a landmark, mm)/∂(ln stiffness of the element), for each landmark.
  std::map<std::string, std::vector<double>> influence;
};

}  // namespace breast
