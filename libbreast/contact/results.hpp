// From a solved compression to what files and reports say about it.
#pragma once

#include "contact/compression.hpp"
#include "contact/solver.hpp"

namespace breast {

/// Fills the mesh (points, det_F, contact record, contact pressure) and the physical part of the
/// summary from the final state.
void record_compression(HexMesh& mesh, const CompressionOptions& options, const BodyState& state,
                        const ContactBody& body, const ContactSolver& solver,
                        const Vec3& wall_springs, CompressionSummary& summary);

}  // namespace breast
