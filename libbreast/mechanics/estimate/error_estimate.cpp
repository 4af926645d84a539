// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/estimate/error_estimate.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "mechanics/estimate/richer_problem.hpp"
#include "solve/krylov/conjugate_gradients.hpp"

namespace breast {

namespace {

// Tolerance relative to the right-hand side of the first step in the preconditioner's norm:
// landmarks are then within a tenth of their converged values.
constexpr double relative_accuracy = 0.02;
constexpr int max_gradient_iterations = 200;
// The error of a landmark is of second order in the mesh size, and so is the effect on it of the
// square of the local strain error: a single linearised step is wrong by half, however fine the
// mesh. The second step includes that square; a third changes the result by a tenth. If the first
// step leaves a larger residual than it started from (a body near its largest load), the second is
// not added.
constexpr int steps = 2;

// Factorises the 8-node problem, which preconditions the richer one.
bool prepare_coarse(const Scene& scene, const State& state, const Vec3& gravity,
                    const ContactEstimate& contact, SaddleMatrix& matrix, SaddleSolver& solver) {
  Problem coarse = scene.problem(scene.gravity_force(gravity)).problem;
  if (contact.plates) coarse.add(contact.plates);
  Request request;
  request.matrix = &matrix;
  request.augmentation = RicherProblem::augmentation;
  if (!coarse.evaluate(state, request).valid) return false;
  Constraints held = coarse.constraints_at(state.x);
  for (const TouchingNode& t : contact.touching) {
    if (held.at(t.node) == nullptr) held.hold_normal(t.node, t.normal);
  }
  return solver.factorise(matrix, held, false).ok;
}

}  // namespace

ErrorEstimate estimate_error(const Scene& scene, const State& state, const Vec3& gravity,
                             SaddleMatrix& matrix, SaddleSolver& solver,
                             const ContactEstimate& contact) {
  ErrorEstimate estimate;
  if (!prepare_coarse(scene, state, gravity, contact, matrix, solver)) return estimate;
  RicherProblem problem(scene, state, gravity, contact);
  if (!problem.valid()) return estimate;
  ConjugateGradientLimits limits{relative_accuracy, 0, max_gradient_iterations};
  Eigen::VectorXd correction = Eigen::VectorXd::Zero(problem.right_hand_side().size()), step;
  double first_residual = 0;  // in the preconditioner's norm
  for (; estimate.steps < steps; ++estimate.steps) {
    if (estimate.steps > 0 && !problem.move(step)) break;
    const ConjugateGradientResult solved = conjugate_gradients(
        [&](const Eigen::VectorXd& v) { return problem.apply(v); },
        [&](const Eigen::VectorXd& v) { return problem.precondition(v, solver); },
        problem.right_hand_side(), limits);
    estimate.iterations += solved.iterations;
    if (!solved.converged || (estimate.steps > 0 && solved.start >= first_residual)) break;
    step = solved.x;
    correction = problem.moved() + step;
    // The second step is solved to the accuracy of the first.
    if (estimate.steps == 0) {
      first_residual = solved.start;
      limits = {0, relative_accuracy * first_residual,
                max_gradient_iterations - estimate.iterations};
    }
  }
  if (estimate.steps == 0) return estimate;
  const std::vector<Vec3> nodal = unflatten(correction);
  for (const Landmark& landmark : problem.mesh().landmarks) {
    const Vec3 error = landmark_position(problem.mesh(), nodal, landmark);
    estimate.landmarks[landmark.name] = error;
    estimate.worst_mm = std::max(estimate.worst_mm, error.norm());
  }
  estimate.usable = true;
  return estimate;
}

void note_estimate(const ErrorEstimate& estimate, const std::string& condition,
                   SolveSummary& summary) {
  if (!estimate.usable) return;
  summary.error_estimate_mm = estimate.worst_mm;
  summary.landmark_error_mm = estimate.landmarks;
  summary.error_estimate_how =
      message(estimate.how(), condition, ": discretisation only, not geometry, labels or laws");
}

}  // namespace breast
