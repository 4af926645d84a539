// A plate's constraint on a node.
#pragma once

#include "solve/constraints.hpp"

namespace breast {

/// Holds the node along the plate's `normal` (unit), moved by `increment` (mm). The node may already
/// be held in other directions (a symmetry plane at right angles to the plate).
void hold_on_plate(Constraints& all, int node, const Vec3& normal, double increment);

}  // namespace breast
