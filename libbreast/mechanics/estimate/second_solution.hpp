// SPDX-License-Identifier: GPL-3.0-or-later
// The discretisation error of 8-node elements from a second, complete solution with 27-node
// elements on the same geometry: expensive, but without the truncated iteration of
// mechanics/estimate/error_estimate.hpp.
#pragma once

#include <functional>

#include "mechanics/mechanics.hpp"

namespace breast {

/// `solved` is a converged solution on `mesh` of 8-node elements; `solve` solves the same scene on
/// the mesh it is given. Fills the error estimate (largest distance of a landmark between the two,
/// mm) and the phase "error estimate". If the second solve does not converge, or the first one
/// already used 27-node elements, a doubt is added instead.
void estimate_by_second_solution(
    const HexMesh& mesh, MechanicsOptions options, Equilibrium& solved,
    const std::function<Equilibrium(const HexMesh&, const MechanicsOptions&)>& solve);

}  // namespace breast
