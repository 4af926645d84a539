// The plates of a compressed state as the error estimate sees them.
#pragma once

#include <memory>

#include "contact/solvers/surface_contact.hpp"
#include "mechanics/estimate/error_estimate.hpp"

namespace breast {

/// Plates that press on faces: on the mesh of 27-node elements their forces are those on its faces where
/// they lie now, and nodes under pressure are held along their normals. Both arguments must outlive
/// the answer.
ContactEstimate estimate_of_faces(const SurfaceContact& contact, const State& state);

/// Plates that hold nodes along their normals; `friction` may be null. `mesh` and `state` must outlive
/// the answer.
ContactEstimate estimate_of_nodes(const ContactSolver& contact, const PlatePair& plates,
                                  const std::shared_ptr<FrictionTerm>& friction,
                                  const HexMesh& mesh, const State& state);

}  // namespace breast
