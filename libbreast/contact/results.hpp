// SPDX-License-Identifier: GPL-3.0-or-later
// Records the results of a solved compression for files and reports.
#pragma once

#include "contact/compression.hpp"
#include "contact/solvers/solver.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Fills the contact record, the contact pressure and the physical quantities of the result from
/// the final state, the last of `result.path`. `load`: the forces on the body besides the plates', µN.
void record_compression(const Scene& scene, const CompressionOptions& options, const State& state,
                        const ContactSolver& solver, const Vec3& load, CompressionResult& result);

}  // namespace breast
