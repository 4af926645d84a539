#include "mechanics/error_estimate.hpp"

#include <algorithm>

#include "mechanics/richer_problem.hpp"

namespace breast {

namespace {

// Of the first step's right-hand side in the preconditioner's norm: landmarks then are within a
// tenth of what they converge to.
constexpr double relative_accuracy = 0.02;
constexpr int max_iterations = 200;
// A landmark's error is of second order in the mesh size, and so is what the square of the local
// strain error does to it: a single linearised step is wrong by half, however fine the mesh. The
// second step sees that square; a third changes a tenth.
constexpr int steps = 2;

// Conjugate gradients until the preconditioned residual is `target` or below; `target` zero: made
// from the start's. False: no convergence.
bool solve(const RicherProblem& problem, const SaddleSolver& coarse, double& target,
           int& iterations, Eigen::VectorXd& x) {
  Eigen::VectorXd r = problem.right_hand_side();
  x = Eigen::VectorXd::Zero(r.size());
  Eigen::VectorXd z = problem.precondition(r, coarse), d = z;
  double rz = r.dot(z);
  if (!(target > 0)) target = relative_accuracy * relative_accuracy * rz;
  while (rz > target && iterations < max_iterations) {
    const Eigen::VectorXd ad = problem.apply(d);
    const double curvature = d.dot(ad);
    if (!(curvature > 0)) return false;
    const double alpha = rz / curvature;
    x += alpha * d;
    r -= alpha * ad;
    z = problem.precondition(r, coarse);
    const double next = r.dot(z);
    d = z + (next / rz) * d;
    rz = next;
    ++iterations;
  }
  return rz <= target && x.allFinite();
}

}  // namespace

ErrorEstimate estimate_error(const Scene& scene, const Eigen::VectorXd& reference,
                             const SaddleState& state, const Vec3& gravity, SaddleMatrix& matrix,
                             SaddleSolver& solver, const std::vector<TouchingNode>& touching) {
  ErrorEstimate estimate;
  AssemblyRequest request;
  request.matrix = &matrix;
  request.augmentation = RicherProblem::augmentation;
  if (!scene.assembly().evaluate(reference, state, request).valid) return estimate;
  Constraints held = scene.walls();
  for (const TouchingNode& t : touching) {
    if (held.at(t.node) == nullptr) held.hold_normal(t.node, t.normal);
  }
  if (!solver.factorise(matrix, held, false).ok) return estimate;
  RicherProblem problem(scene, reference, state, gravity, touching);
  if (!problem.valid()) return estimate;
  double target = 0;
  Eigen::VectorXd correction = Eigen::VectorXd::Zero(problem.right_hand_side().size()), step;
  for (; estimate.steps < steps; ++estimate.steps) {
    if (estimate.steps > 0 && !problem.move(step)) break;
    if (!solve(problem, solver, target, estimate.iterations, step)) break;
    correction += step;
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

}  // namespace breast
