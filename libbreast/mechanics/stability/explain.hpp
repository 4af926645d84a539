// SPDX-License-Identifier: GPL-3.0-or-later
// Explanation of a solve without a stable solution: the cause of the instability, and the smallest
// change that would give a stable solution.
#pragma once

#include "core/progress.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/stability/instability.hpp"
#include "mechanics/stability/remedy.hpp"

namespace breast {

/// Records the share of the skin in an instability; if it dominates, the reason names the buckling
/// of compressed skin.
void note_instability(const Instability& instability, SolveSummary& summary);

/// Finds the smallest change that gives a stable solution and adds it to the reason, also whether
/// wrinkling skin would suffice where compressed skin buckles. `stands` solves with one change; it is
/// called about twenty times, so that the search is skipped for meshes of more than
/// `most_nodes_for_remedy` nodes and if the options do not ask for it.
inline constexpr int most_nodes_for_remedy = 30000;
void find_remedy(const HexMesh& mesh, const MechanicsOptions& options, const Stands& stands,
                 Progress& progress, SolveSummary& summary);

}  // namespace breast
