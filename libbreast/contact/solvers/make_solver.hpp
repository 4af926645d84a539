// SPDX-License-Identifier: GPL-3.0-or-later
// Construction of the contact solver that the options select.
#pragma once

#include <memory>

#include "contact/solvers/solver.hpp"
#include "contact/solvers/surface_contact.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Contact of faces, exact contact of nodes, or contact of nodes by the paper's augmented
/// Lagrangian.
enum class ContactMethod { surface, active_set, augmented_lagrangian };

struct ChosenContact {
  std::unique_ptr<ContactSolver> solver;
  const SurfaceContact* surface = nullptr;  ///< the solver in case of surface contact
  std::shared_ptr<FrictionTerm> friction;   ///< of nodes in exact contact; null: none
};

/// `friction` is Coulomb's coefficient; the augmented Lagrangian has no friction. `saddle` must
/// outlive the result.
ChosenContact make_contact_solver(ContactMethod method, double friction, const Scene& scene,
                                  const Problem& body, SaddleSolver& saddle);

}  // namespace breast
