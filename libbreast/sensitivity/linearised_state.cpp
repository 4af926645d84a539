// SPDX-License-Identifier: GPL-3.0-or-later
#include "sensitivity/linearised_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "solve/newton.hpp"

namespace breast {

namespace {

constexpr double solve_tolerance = 1e-10, refined = 1e-6;
constexpr int refinements = 3, most_gmres = 100, most_settling = 4;
// Largest distance of the state in a file from the equilibrium with the given options; a larger
// distance indicates other options. With plates in surface contact it may be some tenths of a
// micrometre in files without face_rules: the faces that get many points depend on the plates' far
// edges, which the file does not store.
constexpr double far_mm = 1e-3, settled = 1e-8;
// Between plates, rounding may leave a hundred times that residual relative to the load, which is
// gravity and small beside the plates' forces. A step that moves no node by a nanometre then cannot
// improve the state.
constexpr double rounded = 1e-6, still_mm = 1e-6;

Constraints with_contacts(Constraints held, const std::vector<PlateContact>& contacts) {
  for (const PlateContact& contact : contacts) held.hold_along(contact.node, contact.normal());
  return held;
}

}  // namespace

LinearisedState::LinearisedState(const Scene& scene, LoadedState state,
                                 std::vector<PlateContact> contacts,
                                 const std::vector<std::shared_ptr<const Term>>& plates,
                                 const std::string& what)
    : scene_(scene),
      problem_(scene.problem(scene.gravity_force(state.gravity)).problem),
      state_(std::move(state)),
      contacts_(std::move(contacts)),
      held_(problem_.nodes()),
      moved_(problem_.nodes()),
      matrix_(problem_.make_matrix()),
      solver_(problem_.space().pattern) {
  for (const auto& term : plates) problem_.add(term);
  settle(what);
}

// Fills both tangents; the curvature of the plates rotates their force as a node slides.
Forces LinearisedState::assemble() {
  Request request;
  request.matrix = &matrix_;
  request.reference = &reference_tangent_;
  Forces forces = problem_.evaluate(state_.state, request);
  if (!forces.valid) return forces;
  for (PlateContact& contact : contacts_) {
    const Vec3 r = forces.r.segment<3>(3L * contact.node);
    contact.force = r.dot(contact.normal());
    matrix_.stiffness.add_to_node(contact.node, -contact.force * contact.gap.hessian);
  }
  return forces;
}

// The state in a file is an equilibrium within its tolerance; only the pressures of 27-node
// elements, stored as means, require a linear solve. If nodes move, the options differ.
void LinearisedState::settle(const std::string& what) {
  const double load =
      std::max(scene_.gravity_force(state_.gravity).norm(), scene_.stiffness_force());
  double moved = 0, last = far_mm;
  for (int i = 0;; ++i) {
    if (problem_.restore(state_.state.x) >= 0) {
      throw input_error(what, ": ", describe(NewtonStop::left_surface));
    }
    const Forces forces = assemble();
    if (!forces.valid) throw input_error(what, ": element ", forces.bad_element, " is folded");
    held_ = with_contacts(problem_.constraints_at(state_.state.x), contacts_);
    moved_ = with_contacts(problem_.constraints_at(state_.state.reference), contacts_);
    Eigen::VectorXd free = forces.r;
    held_.project(free);
    residual_ = free.norm() / load;
    if (!solver_.factorise(matrix_, held_, false).ok) {
      throw failed_error(what, " is an unstable equilibrium, for which there are no derivatives");
    }
    if (residual_ <= settled || (residual_ <= rounded && last <= still_mm)) return;
    const SaddleStep step = solver_.solve(matrix_, forces.r, forces.theta, 1e-8);
    last = step.u.cwiseAbs().maxCoeff();
    moved = std::max(moved, last);
    if (i == most_settling || !(moved <= far_mm)) {
      throw input_error(
          what, " is not an equilibrium under these options (residual ", residual_,
          " of the load, a node would move ", moved,
          " mm): give the mechanics options and the gravity with which the file was made");
    }
    state_.state.x += step.u;
    state_.state.p += step.p;
  }
}

Imbalance LinearisedState::apply(const Direction& change) const {
  const PressureSpace& space = *matrix_.space;
  return {matrix_.multiply_unaugmented(change.u) - matrix_.divergence.apply_transpose(change.p),
          matrix_.divergence.apply(change.u) + space.multiply(change.p, space.compliance)};
}

// Iterative refinement: the pressures come from conjugate gradients.
void LinearisedState::refine(const Imbalance& right, Direction& solution) const {
  double left = 0;  // of the last correction, relative
  for (int i = 0; i < refinements; ++i) {
    const Imbalance now = apply(solution);
    const SaddleStep step =
        solver_.solve(matrix_, now.force - right.force, now.volume - right.volume, solve_tolerance);
    solution.u += step.u;
    solution.p += step.p;
    if (!(step.u.norm() > solve_tolerance * solution.u.norm())) return;
    left = step.u.norm() / solution.u.norm();
  }
  // A correction this small does not affect the digits for which a derivative is used.
  if (!(left <= refined)) {
    throw failed_error("the linear system of the derivatives was not solved: the last of ",
                       refinements, " refinements still changes it by ", left,
                       " of its size, bound ", refined);
  }
}

Direction LinearisedState::solve(const Imbalance& right, const Eigen::VectorXd* imposed) const {
  Direction solution{Eigen::VectorXd::Zero(right.force.size()),
                     Eigen::VectorXd::Zero(right.volume.size())};
  if (imposed != nullptr) solution.u = *imposed;
  refine(right, solution);
  return solution;
}

// K is symmetric: with μ = −q the transposed system is that of (force, −volume).
Direction LinearisedState::solve_transposed(const Imbalance& right) const {
  Direction solution = solve({right.force, -right.volume});
  solution.p = -solution.p;
  return solution;
}

Imbalance LinearisedState::of_reference(const Eigen::VectorXd& change) const {
  return {reference_tangent_.apply(change), reference_tangent_.b_x.apply(change)};
}

Eigen::VectorXd LinearisedState::of_reference_transposed(const Direction& weights) const {
  return reference_tangent_.apply_transpose(weights.u) +
         reference_tangent_.b_x.apply_transpose(weights.p);
}

Direction LinearisedState::checked(const ReferenceStep& step) const {
  if (!(step.residual <= 1e3 * solve_tolerance)) {
    throw failed_error("the linearised inverse problem was not solved: relative residual ",
                       step.residual, " after ", step.iterations, " GMRES iterations");
  }
  return {step.x, step.p};
}

Direction LinearisedState::solve_reference(const Imbalance& right) const {
  const double size = std::cbrt(scene_.solid().space()->pressures->volume(0));
  return checked(ReferenceSystem(matrix_, reference_tangent_, solver_, moved_, size)
                     .solve(right.force, right.volume, solve_tolerance, most_gmres));
}

Direction LinearisedState::solve_reference_transposed(const Imbalance& right) const {
  const double size = std::cbrt(scene_.solid().space()->pressures->volume(0));
  return checked(ReferenceSystem(matrix_, reference_tangent_, solver_, moved_, size)
                     .solve_transposed(right.force, right.volume, solve_tolerance, most_gmres));
}

}  // namespace breast
