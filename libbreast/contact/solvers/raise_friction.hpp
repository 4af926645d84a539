// SPDX-License-Identifier: GPL-3.0-or-later
// Transfer of friction from a solution with 8-node elements to the 27-node mesh of its error
// estimate.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "contact/terms/friction.hpp"
#include "mechanics/estimate/error_estimate.hpp"

namespace breast {

/// The same tractions, anchors and stick stiffness per area: every node of a face whose corners are
/// all held by one plate receives its share of the face, ∫N dA, in the shape `x` (3 per node of the
/// 8-node mesh).
std::shared_ptr<const Term> raise_friction(const FrictionTerm& coarse, const HexMesh& mesh,
                                           const Eigen::VectorXd& x, const RicherMesh& richer);

}  // namespace breast
