// SPDX-License-Identifier: GPL-3.0-or-later
// Reason why the plates could not be closed further, as an identifier and as a sentence.
#pragma once

#include <Eigen/Core>
#include <string>

#include "contact/path/path.hpp"
#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// `id` is stable: "folds_at_plate_edge", "folds_on_chest_wall", "folds_between_edge_and_wall",
/// "folds_behind_plates", "folds_between_plates" (where the worst element of the refused step
/// lies); the same five with "shrinks_" for "folds_" (no element folds, but one shrinks too much in
/// one step, or its law overflows); "iteration_limit", "indefinite_tangent", "no_admissible_step";
/// "solve_limit", "cost_limit" and "out_of_reach" (a target force or pressure not reached by almost closed
/// plates).
struct StopReason {
  std::string id, sentence;
};

/// For a path that did not reach its target. `good`: the last equilibrium, 3 per node.
StopReason explain_stop(const HexMesh& mesh, const Eigen::VectorXd& good, const PathResult& path,
                        const PlatePair& plates);

}  // namespace breast
