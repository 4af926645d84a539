// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria at evenly spaced positions of the plates on the way of a compression.
#pragma once

#include <vector>

#include "contact/compression.hpp"

namespace breast {

/// Solves for `count` positions of the plates from first contact on, in equal steps of thickness of
/// which the next would be the end of found.path (with PathResult::kept). Each is sought from the position of the path
/// before it, with the friction and the load that the path had there, to path.tolerance; the path itself
/// stays as it is. Where none is found, the position of the path nearest to it is solved to the tolerance
/// instead, and a state that is not found even there has a status, a reason and no shape. `load` is
/// what path.prepare sets. Leaves plates, load and memory of `contact` anywhere.
std::vector<ClosingState> solve_closing(const Scene& scene, const CompressionOptions& options,
                                        const CompressionResult& found, const PathOptions& path,
                                        const DeadLoad& load, int count, ContactSolver& contact,
                                        Progress& progress);

}  // namespace breast
