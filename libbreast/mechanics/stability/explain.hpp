// SPDX-License-Identifier: GPL-3.0-or-later
// What a solve without a stable answer says beyond that: what carries the instability, and the
// smallest change that would make the answer stable.
#pragma once

#include "mechanics/equilibrium.hpp"
#include "mechanics/stability/instability.hpp"
#include "mechanics/stability/remedy.hpp"

namespace breast {

/// Notes the share of the skin in an instability; where it is most of it, the reason names the
/// buckling of compressed skin.
void note_instability(const Instability& instability, SolveSummary& summary);

/// Finds the smallest change that gives a stable answer and adds it to the reason; also whether skin
/// that wrinkles would do where compressed skin buckles. Solves some twenty times: meshes of more
/// than `most_nodes_for_remedy` nodes, and options that do not ask for it, are left without.
inline constexpr int most_nodes_for_remedy = 30000;
void find_remedy(const HexMesh& mesh, const MechanicsOptions& options, const Stands& stands,
                 SolveSummary& summary);

}  // namespace breast
