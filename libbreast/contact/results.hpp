// From a solved compression to what files and reports say about it.
#pragma once

#include "contact/compression.hpp"
#include "contact/solver.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Fills contact record, contact pressure and the physical part of the result from the final state,
/// the last of `result.path`.
void record_compression(const Scene& scene, const CompressionOptions& options, const State& state,
                        const ContactSolver& solver, const Vec3& weight,
                        CompressionResult& result);

}  // namespace breast
