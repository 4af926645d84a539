// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of an identification: landmarks that contradict each other or the mesh.
#pragma once

#include "identification/identify.hpp"

namespace breast {

/// Throws Error (input) when two landmarks would be met if their places in the second posture were
/// exchanged; Error (not converged) when one landmark lies far from where all others put it or the best
/// answer leaves most of the motion unexplained.
void check_agreement(const HexMesh& mesh, const Observations& seen, const Identified& found);

/// What a reader should know before using the answer: an answer at the limit of stable bodies, a misfit
/// beyond the observers' errors, mostly the prior.
std::vector<std::string> doubts_of(const Identified& found);

}  // namespace breast
