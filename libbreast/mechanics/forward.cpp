#include <chrono>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/error_estimate.hpp"
#include "mechanics/field_checks.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

class ForwardSolve {
 public:
  ForwardSolve(HexMesh& mesh, const MechanicsOptions& options, bool hasty, Progress& progress)
      : mesh_(mesh), scene_(mesh, options), hasty_(hasty), progress_(progress) {}

  SolveSummary run(const Vec3& gravity);

 private:
  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  NewtonResult attempt(ForwardProblem& problem, SaddleSolver& solver, SaddleMatrix& matrix,
                       SaddleState& state, int limit);
  NewtonResult follow(ForwardProblem& problem, const Eigen::VectorXd& load, SaddleSolver& solver,
                      SaddleMatrix& matrix, SaddleState& state);
  void check_stability(const SaddleMatrix& matrix, SaddleSolver& solver);
  void estimate(const Eigen::VectorXd& reference, const SaddleState& state, const Vec3& gravity,
                SaddleMatrix& matrix, SaddleSolver& solver);

  HexMesh& mesh_;
  Scene scene_;
  bool hasty_;
  Progress& progress_;
  SolveSummary summary_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

NewtonResult ForwardSolve::attempt(ForwardProblem& problem, SaddleSolver& solver,
                                   SaddleMatrix& matrix, SaddleState& state, int limit) {
  NewtonOptions newton_options;
  newton_options.max_iterations = limit;
  newton_options.reuse_factor = true;
  newton_options.hasty = hasty_;
  newton_options.timer = &summary_.timer;
  ++summary_.steps;
  NewtonResult result = newton(problem, solver, matrix, scene_.walls(), nullptr, state,
                               newton_options, [&](const NewtonIteration& iteration) {
                                 record_iteration(summary_, summary_.steps, iteration, clock());
                                 progress_.update("forward", -1,
                                                  message("iteration ", summary_.newton_iterations,
                                                          ", residual ", iteration.residual));
                               });
  summary_.factorisations += result.factorisations;
  return result;
}

// Follows the load from `state`; on success that is the last equilibrium.
NewtonResult ForwardSolve::follow(ForwardProblem& problem, const Eigen::VectorXd& load,
                                  SaddleSolver& solver, SaddleMatrix& matrix, SaddleState& state) {
  NewtonResult result;
  LoadPath path;
  while (!path.finished()) {
    problem.set_load(path.next() * load);
    SaddleState trial = state;
    result = attempt(problem, solver, matrix, trial, summary_.steps == 0 ? 25 : 12);
    if (result.converged) {
      state = std::move(trial);
      path.succeed();
    } else if (hasty_ || !path.fail()) {
      summary_.reason_id = stop_name(result.stop);
      summary_.load_reached = path.done;
      summary_.record.reason =
          message("stopped at ", 100 * path.done, " % of the load: ", result.reason);
      break;
    }
  }
  return result;
}

// Whether the equilibrium found is known to be stable, from the last tangent. Where the start was
// the equilibrium there is no factor of it yet.
void ForwardSolve::check_stability(const SaddleMatrix& matrix, SaddleSolver& solver) {
  Timer::Scope phase(summary_.timer, "stability");
  if (solver.factorisations() == 0) solver.factorise(matrix, scene_.walls(), false);
  if (solver.positive_definite()) return;
  if (hasty_) {
    summary_.record.status = "not_converged";
    summary_.record.reason = "the equilibrium found is not known to be stable";
  } else {
    summary_.doubts.push_back(
        "the last tangent is not known to be positive definite: the equilibrium may be unstable");
  }
}

void ForwardSolve::estimate(const Eigen::VectorXd& reference, const SaddleState& state,
                            const Vec3& gravity, SaddleMatrix& matrix, SaddleSolver& solver) {
  if (mesh_.order != 1 || scene_.options().estimate != Estimate::step) return;
  Timer::Scope phase(summary_.timer, "error estimate");
  const ErrorEstimate estimate = estimate_error(scene_, reference, state, gravity, matrix, solver);
  if (!estimate.usable || mesh_.landmarks.empty()) return;
  summary_.error_estimate_mm = estimate.worst_mm;
  summary_.landmark_error_mm = estimate.landmarks;
  summary_.error_estimate_how =
      message(estimate.how(), ": discretisation only, not geometry, labels or laws");
}

SolveSummary ForwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd reference = flatten(mesh_.reference);
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  ForwardProblem problem(scene_, reference, load);
  SaddleState state{reference, scene_.assembly().rest_pressure()};
  NewtonResult result;
  {
    SaddleMatrix matrix = problem.make_matrix();
    SaddleSolver solver = [&] {
      Timer::Scope phase(summary_.timer, "ordering");
      return SaddleSolver(problem.pattern(), scene_.assembly().solver());
    }();
    result = follow(problem, load, solver, matrix, state);
    summary_.record.status = result.converged ? "converged" : "not_converged";
    note_solver(solver, matrix, summary_);
    if (result.converged) check_stability(matrix, solver);
    if (summary_.converged()) estimate(reference, state, gravity, matrix, solver);
  }
  if (hasty_ && !summary_.converged()) return summary_;
  if (result.indefinite > 0) {
    summary_.doubts.push_back(message("the tangent was indefinite in ", result.indefinite,
                                      " iterations: the breast may buckle"));
  }
  summary_.residual = result.residual;
  summary_.min_det_F = result.forces.min_det_F;
  store_state(mesh_, scene_, reference, state, summary_);
  mesh_.gravity = gravity;
  judge(summary_, scene_, reference, state);
  check_fields(mesh_, scene_.options(), mesh_.reference, mesh_.points, summary_);
  return summary_;
}

}  // namespace

SolveSummary solve_forward(HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                           Progress& progress) {
  if (mesh.reference.size() != mesh.points.size()) {
    throw input_error("mesh: no stress-free reference shape; run backward first");
  }
  return with_chosen_solver(3.0 * mesh.nodes(), options, progress,
                            [&](const MechanicsOptions& chosen, bool hasty) {
                              return ForwardSolve(mesh, chosen, hasty, progress).run(gravity);
                            });
}

}  // namespace breast
