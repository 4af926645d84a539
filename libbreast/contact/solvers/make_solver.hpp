// SPDX-License-Identifier: GPL-3.0-or-later
// The contact solver that options ask for.
#pragma once

#include <memory>

#include "contact/solvers/solver.hpp"
#include "contact/solvers/surface_contact.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Faces kept out of the plates; nodes, exactly; or nodes by the paper's augmented Lagrangian.
enum class ContactMethod { surface, active_set, augmented_lagrangian };

struct ChosenContact {
  std::unique_ptr<ContactSolver> solver;
  const SurfaceContact* surface = nullptr;  ///< the solver where faces touch
  std::shared_ptr<FrictionTerm> friction;   ///< where nodes touch, exactly; null: none
};

/// `friction`: Coulomb's coefficient, none for the augmented Lagrangian. `saddle` must outlive the result.
ChosenContact make_contact_solver(ContactMethod method, double friction, const Scene& scene,
                                  const Problem& body, SaddleSolver& saddle);

}  // namespace breast
