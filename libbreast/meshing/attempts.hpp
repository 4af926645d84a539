// SPDX-License-Identifier: GPL-3.0-or-later
// What is tried, and in which order, until the worst element of a mesh is well shaped.
#pragma once

#include <string>
#include <vector>

#include "meshing/dome.hpp"
#include "meshing/smooth.hpp"

namespace breast {

/// Worst scaled Jacobian with which a dome is taken at once. The flat corners of the cuboid cannot
/// have it: a cuboid is taken as soon as it is not folded.
inline constexpr double wanted_scaled_jacobian = 0.2;

struct MeshAttempt {
  /// What differs from the mesh that was asked for: template, layers, smoothing, untangling, elements;
  /// empty for that mesh itself.
  std::string step;
  DomeSize size;
  SmoothOptions smoothing;
};

/// The mesh that was asked for comes first. The others follow in this order: a dome in place of a
/// cuboid; other proportions of core, layers and cut with about as many elements; four times the
/// smoothing; untangling that lets nodes move farther; and fewer or more elements.
std::vector<MeshAttempt> mesh_attempts(const DomeSize& size, const SmoothOptions& smoothing);

}  // namespace breast
