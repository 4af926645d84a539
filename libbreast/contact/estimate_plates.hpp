// SPDX-License-Identifier: GPL-3.0-or-later
// Contact data of a compressed state for the discretisation error estimate.
#pragma once

#include <memory>

#include "contact/solvers/solver.hpp"
#include "contact/terms/friction.hpp"
#include "mechanics/estimate/error_estimate.hpp"

namespace breast {

/// Contact data of plates that hold nodes along their normals; `friction` may be null. `mesh` and
/// `state` must outlive the result.
ContactEstimate estimate_of_nodes(const ContactSolver& contact, const PlatePair& plates,
                                  const std::shared_ptr<FrictionTerm>& friction,
                                  const HexMesh& mesh, const State& state);

}  // namespace breast
