// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of an identification: landmarks that contradict each other or the mesh.
#pragma once

#include "identification/identify.hpp"

namespace breast {

/// Throws Error (input) if two landmarks would agree with the model when interchanged in the second
/// posture; Error (not converged) if one landmark is far from where the others predict it, or if
/// the best fit leaves most of the motion unexplained.
void check_agreement(const HexMesh& mesh, const Observations& seen, const Identified& found);

/// Doubts about the solution: it lies at the limit of stable bodies, the misfit exceeds the
/// observers' errors, or the result is mostly the prior.
std::vector<std::string> doubts_of(const Identified& found);

}  // namespace breast
