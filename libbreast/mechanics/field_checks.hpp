// What the solved fields say about their own worth: pressure oscillation and wrinkling skin.
#pragma once

#include "mechanics/mechanics.hpp"

namespace breast {

/// From a solved state (mesh.pressure and the two shapes): fills summary.pressure (8-node elements)
/// and summary.skin, and adds what to doubt.
void check_fields(const HexMesh& mesh, const MechanicsOptions& options,
                  const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed,
                  SolveSummary& summary);

}  // namespace breast
