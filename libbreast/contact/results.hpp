// SPDX-License-Identifier: GPL-3.0-or-later
// From a solved compression to what files and reports say about it.
#pragma once

#include "contact/compression.hpp"
#include "contact/solvers/surface_contact.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Fills contact record, contact pressure and the physical part of the result from the final state,
/// the last of `result.path`. `surface`: the solver where faces touch, else null.
void record_compression(const Scene& scene, const CompressionOptions& options, const State& state,
                        const ContactSolver& solver, const SurfaceContact* surface,
                        const Vec3& weight, CompressionResult& result);

}  // namespace breast
