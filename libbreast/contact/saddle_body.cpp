#include "contact/saddle_body.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace breast {

namespace {
/// Relative residual of the volume equation in each linearised solve: its remainder is taken up by
/// the next iteration.
constexpr double volume_solve_tolerance = 1e-4;

/// The plate's constraint at a node that may already be held in other directions (a symmetry plane
/// at right angles to the plate).
void hold_on_plate(Constraints& all, const NormalConstraint& plate) {
  const NodeConstraint* held = all.at(plate.node);
  if (held == nullptr) {
    all.hold_normal(plate.node, plate.normal, plate.increment);
    return;
  }
  NodeConstraint both = *held;
  Vec3 rest = plate.normal;
  for (int i = 0; i < 3; ++i) {
    if (held->held[i]) rest -= rest.dot(held->axes.col(i)) * held->axes.col(i);
  }
  const double part = rest.norm();
  if (!(part > 1e-6)) return;  // the plate can move the node nowhere
  // The first free axis turns to the plate's normal, the other follows.
  int first = 0;
  while (held->held[first]) ++first;
  const int second = (first + 1) % 3, third = (first + 2) % 3;
  both.axes.col(first) = rest / part;
  if (held->held[second] != held->held[third]) {
    const int kept = held->held[second] ? second : third,
              free = held->held[second] ? third : second;
    both.axes.col(free) = both.axes.col(first).cross(both.axes.col(kept));
  }
  both.held[first] = true;
  both.increment[first] = plate.increment / part;
  all.set(plate.node, both);
}
}  // namespace

SaddleBody::SaddleBody(const SaddleProblem& problem, SaddleSolver& solver, const Constraints& held,
                       const Vec3& weight)
    : problem_(problem),
      solver_(solver),
      held_(held),
      weight_(weight),
      matrix_(problem.make_matrix()) {}

int SaddleBody::nodes() const {
  return problem_.pattern()->nodes();
}

bool SaddleBody::forces(const BodyState& state, BodyForces& forces) {
  SaddleForces at =
      problem_.forces({state.x, state.p}, matrix_.kappa.size() > 0 ? &matrix_.kappa : nullptr);
  if (!at.valid) return false;
  if (!(at.min_det_F > determinant_guard * std::min(1.0, assembled_det_F_))) return false;
  forces.residual = std::move(at.r);
  forces.augmented = std::move(at.augmented);
  forces.min_det_F = at.min_det_F;
  forces.max_det_F = at.max_det_F;
  forces.max_volume_error = at.max_volume_error;
  forces.volume_residual = 0;
  const long rows = at.theta.size() / at.element_count;
  for (long i = 0; i < at.theta.size(); ++i) {
    forces.volume_residual = std::max(forces.volume_residual,
                                      std::abs(at.theta[i]) / problem_.volume_scale(int(i / rows)));
  }
  return true;
}

bool SaddleBody::assemble(const BodyState& state) {
  SaddleForces at;
  if (!problem_.tangent({state.x, state.p}, at, matrix_)) return false;
  theta_ = std::move(at.theta);
  assembled_det_F_ = at.min_det_F;
  return true;
}

void SaddleBody::add_to_tangent(int node, const Mat3& block) {
  matrix_.stiffness.add_to_node(node, block);
}

BodySolve SaddleBody::solve(const std::vector<NormalConstraint>& constraints,
                            const Eigen::VectorXd& residual, BodyState& increment) {
  Constraints all = held_;
  for (const NormalConstraint& c : constraints) hold_on_plate(all, c);
  const Factorisation factor = solver_.factorise(matrix_, all);
  if (!factor.ok) return {};
  SaddleStep step = solver_.solve(matrix_, residual, theta_, volume_solve_tolerance);
  increment.x = std::move(step.u);
  increment.p = std::move(step.p);
  const double slope = increment.x.dot(matrix_.stiffness.multiply(increment.x));
  return {true, factor.shift > 0, slope};
}

}  // namespace breast
