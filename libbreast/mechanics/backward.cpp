// The inverse problem: X such that the imaged shape x is in equilibrium. The residual is that of
// forward, R(X, x, p) = 0 with x given, so that forward returns the imaged shape to rounding error.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/chosen_solver.hpp"
#include "mechanics/field_checks.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/reference_system.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

constexpr int max_iterations = 25, max_gmres = 60;
// The forward factor only preconditions: one serves until GMRES needs more iterations than this,
// whose back-solves cost as much as a factorisation.
constexpr int factor_worn = 10, levels_worn = 45;
constexpr double tolerance = 1e-10, volume_tolerance = 1e-11;
// A volume error of this size counts as much as the whole load when steps are judged.
constexpr double typical_strain = 0.05;
constexpr double nearly_incompressible = 100;  // κ/μ
constexpr const char* singular = "singular_inverse";

class BackwardSolve {
 public:
  BackwardSolve(HexMesh& mesh, const MechanicsOptions& options, bool hasty, Progress& progress)
      : mesh_(mesh),
        scene_(mesh, options),
        hasty_(hasty),
        progress_(progress),
        imaged_(flatten(mesh.imaged)),
        matrix_(scene_.assembly().make_matrix()),
        solver_(scene_.assembly().pattern(), scene_.assembly().solver()) {}

  /// Nodal forces (µN); `start` is the first guess, and where held nodes stay.
  SolveSummary run(const Eigen::VectorXd& load, const Eigen::VectorXd& start);
  SolveSummary run(const Vec3& gravity);

 private:
  struct Trial {
    Eigen::VectorXd reference, pressure;
  };
  // How far a state is from equilibrium.
  struct Distance {
    double force = 0, volume = 0;  // relative to the load; worst |θ_e|/V_e
    double merit = 0;
  };

  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  SaddleForces evaluate(const Trial& trial, SaddleMatrix* matrix, ReferenceTangent* tangent,
                        double augmentation = 0) const;
  Distance distance(const SaddleForces& forces) const;
  bool precondition_at(const Trial& trial);
  bool direction(const SaddleForces& forces, double accuracy, Trial& step);
  bool line_search(const Trial& step, const Distance& before, const SaddleForces& at, Trial& trial,
                   NewtonIteration& record) const;
  bool newton(Trial& trial);
  void set_load(const Eigen::VectorXd& load);
  /// From `state` to the full load, in parts when need be; the part reached.
  double follow(const Eigen::VectorXd& load, Trial& state);
  bool stays(const Trial& trial);
  void conclude(const Trial& state, double reached);
  double stable_part(const Eigen::VectorXd& load, double reached, bool stable);
  void store(const Trial& state);

  HexMesh& mesh_;
  Scene scene_;
  bool hasty_;
  Progress& progress_;
  Eigen::VectorXd imaged_, load_;
  double load_norm_ = 1;
  SaddleMatrix matrix_;
  SaddleSolver solver_;
  ReferenceTangent tangent_;
  SolveSummary summary_;
  std::string failure_, failure_id_;
  int last_gmres_ = max_gmres;  // iterations with the present factor; none yet
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

SaddleForces BackwardSolve::evaluate(const Trial& trial, SaddleMatrix* matrix,
                                     ReferenceTangent* tangent, double augmentation) const {
  AssemblyRequest request;
  request.matrix = matrix;
  request.augmentation = augmentation;
  request.reference = tangent;
  SaddleForces forces =
      scene_.assembly().evaluate(trial.reference, {imaged_, trial.pressure}, request);
  if (forces.valid) forces.r -= load_;
  return forces;
}

BackwardSolve::Distance BackwardSolve::distance(const SaddleForces& forces) const {
  Distance out;
  Eigen::VectorXd free = forces.r;
  scene_.walls().project(free);
  out.force = free.norm() / load_norm_;
  const std::vector<double>& volume = scene_.assembly().imaged_volume();
  const long rows = scene_.assembly().pressures()->rows;
  double square = 0;
  for (long i = 0; i < forces.theta.size(); ++i) {
    const double error = std::abs(forces.theta[i]) / volume[i / rows];
    out.volume = std::max(out.volume, error);
    square += error * error;
  }
  square /= double(std::max<long>(1, forces.theta.size())) * typical_strain * typical_strain;
  out.merit = std::sqrt(out.force * out.force + square);
  return out;
}

// Factorises the forward tangent at the trial, for GMRES.
bool BackwardSolve::precondition_at(const Trial& trial) {
  {
    Timer::Scope phase(summary_.timer, "assembly");
    if (!evaluate(trial, &matrix_, nullptr).valid) return false;
  }
  Timer::Scope phase(summary_.timer, "factorisation");
  last_gmres_ = 0;
  return solver_.factorise(matrix_, scene_.walls(), !hasty_).ok;
}

bool BackwardSolve::direction(const SaddleForces& forces, double accuracy, Trial& step) {
  Timer::Scope phase(summary_.timer, "solve");
  const double size = std::cbrt(scene_.assembly().imaged_volume()[0]);
  const ReferenceStep solved = ReferenceSystem(matrix_, tangent_, solver_, size)
                                   .solve(-forces.r, -forces.theta, accuracy, max_gmres);
  last_gmres_ = solved.iterations;
  if (!(solved.residual < 0.5) || (hasty_ && solved.iterations == max_gmres)) return false;
  step = {solved.x, solved.p};
  return true;
}

bool BackwardSolve::line_search(const Trial& step, const Distance& before, const SaddleForces& at,
                                Trial& trial, NewtonIteration& record) const {
  for (double length = 1; length >= 1.0 / 64; length *= 0.5) {
    Trial next{trial.reference + length * step.reference, trial.pressure + length * step.pressure};
    const SaddleForces forces = evaluate(next, nullptr, nullptr);
    if (!forces.valid || !(forces.max_det_F < 20 * std::max(1.0, at.max_det_F))) continue;
    const Distance now = distance(forces);
    if (!(now.merit < before.merit)) continue;
    record = {now.force, forces.min_det_F, forces.max_det_F, length, 0};
    trial = std::move(next);
    return true;
  }
  return false;
}

bool BackwardSolve::newton(Trial& trial) {
  ++summary_.steps;
  for (int i = 0; i <= max_iterations; ++i) {
    SaddleForces forces;
    {
      Timer::Scope phase(summary_.timer, "assembly");
      forces = evaluate(trial, nullptr, &tangent_);
    }
    if (!forces.valid) {
      failure_ = message("element ", forces.bad_element, " is folded at the start");
      failure_id_ = stop_name(NewtonStop::folded);
      return false;
    }
    const Distance now = distance(forces);
    summary_.residual = now.force;
    summary_.min_det_F = forces.min_det_F;
    const double bound = std::max(tolerance, rounding_force(matrix_, imaged_) / load_norm_);
    if (now.force <= bound && now.volume <= volume_tolerance) return true;
    if (i == max_iterations) break;
    const bool worn =
        last_gmres_ > (solver_.kind() == LinearSolver::direct ? factor_worn : levels_worn);
    if (worn && !precondition_at(trial)) {
      failure_ = "the forward tangent cannot be factorised";
      failure_id_ = singular;
      return false;
    }
    Trial step;
    const double accuracy = std::clamp(0.1 * now.merit, 1e-6, 1e-3);
    if (!direction(forces, accuracy, step) &&
        (worn || !precondition_at(trial) || !direction(forces, accuracy, step))) {
      failure_ = "the inverse problem is singular";
      failure_id_ = singular;
      return false;
    }
    NewtonIteration record;
    Timer::Scope phase(summary_.timer, "line search");
    if (!line_search(step, now, forces, trial, record)) {
      failure_ = message("no admissible step: residual ", now.force, " of the load");
      failure_id_ = stop_name(NewtonStop::no_step);
      return now.force <= 1e-8 && now.volume <= 1e-9;
    }
    record.linear_iterations = last_gmres_;
    record_iteration(summary_, summary_.steps, record, clock());
    progress_.update(
        "backward", -1,
        message("iteration ", summary_.newton_iterations, ", residual ", record.residual));
  }
  failure_ = message("no convergence in ", max_iterations, " iterations: residual ",
                     summary_.residual, " of the load");
  failure_id_ = stop_name(NewtonStop::iteration_limit);
  return false;
}

// Is the imaged shape a stable equilibrium of the unloaded shape found? Of a folded one it is not.
bool BackwardSolve::stays(const Trial& trial) {
  Timer::Scope phase(summary_.timer, "stability");
  const auto definite = [&](double augmentation) {
    return evaluate(trial, &matrix_, nullptr, augmentation).valid &&
           solver_.factorise(matrix_, scene_.walls(), false).ok && solver_.positive_definite();
  };
  // The augmentation that suits a multigrid need not hold what incompressibility holds.
  bool stable = definite(0);
  if (!stable && !hasty_ && solver_.kind() == LinearSolver::multigrid) {
    stable = definite(nearly_incompressible);
    last_gmres_ = max_gmres;
  }
  if (!stable) last_gmres_ = max_gmres;  // nothing is left to precondition with
  return stable;
}

void BackwardSolve::set_load(const Eigen::VectorXd& load) {
  load_ = load;
  Eigen::VectorXd free = load_;
  scene_.walls().project(free);
  load_norm_ = free.norm() > 0 ? free.norm() : scene_.stiffness_force();
}

double BackwardSolve::follow(const Eigen::VectorXd& load, Trial& state) {
  LoadPath path;
  while (!path.finished()) {
    set_load(path.next() * load);
    Trial trial = state;
    if (newton(trial)) {
      state = std::move(trial);
      path.succeed();
    } else if (hasty_ || !path.fail()) {
      break;
    }
  }
  return path.done;
}

// Newton's direction always lowers the residual unless ∂R/∂X is singular: where the path of
// solutions stops for want of a step or of a direction, it ends. Short of any load it may be that
// steps were too long.
void BackwardSolve::conclude(const Trial& state, double reached) {
  summary_.load_reached = reached;
  summary_.stable = reached > 0 ? stays(state) : true;
  SolveRecord& record = summary_.record;
  if (reached < 1) {
    const bool ends =
        reached > 0 && (failure_id_ == singular || failure_id_ == stop_name(NewtonStop::no_step));
    record.status = "not_converged";
    summary_.reason_id = ends ? "no_stress_free_body" : failure_id_;
    record.reason = message("stopped at ", 100 * reached, " % of the load: ", failure_);
    if (ends) {
      record.reason = message(
          "no stress-free body: the shapes that gravity could deform into the "
          "imaged one end near ",
          100 * reached, " % of the load (", failure_, ")");
    }
  } else if (!summary_.stable) {
    record.status = "unstable";
    summary_.reason_id = "unstable_equilibrium";
    record.reason =
        "unstable equilibrium: the body found is in balance in the imaged shape but would not stay "
        "in it";
  } else {
    record.status = "converged";
  }
}

// Stiffnesses times s under the full load are the same problem as part 1/s of the load: the largest
// part found, within 10 %, whose body exists and stays in the imaged shape.
double BackwardSolve::stable_part(const Eigen::VectorXd& load, double reached, bool stable) {
  if (stable) return reached;
  double low = 0, high = reached;
  for (int i = 0; i < 7 && high > 1.1 * low; ++i) {
    const double part = low > 0 ? std::sqrt(low * high) : 0.4 * high;
    set_load(part * load);
    Trial trial{imaged_, scene_.assembly().rest_pressure()};
    (newton(trial) && stays(trial) ? low : high) = part;
  }
  return low;
}

void BackwardSolve::store(const Trial& state) {
  note_solver(solver_, matrix_, summary_);
  summary_.factorisations = solver_.factorisations();
  store_state(mesh_, scene_, state.reference, {imaged_, state.pressure}, summary_);
  mesh_.points = mesh_.reference;
  mesh_.gravity.setZero();
  judge(summary_, scene_, state.reference, {imaged_, state.pressure});
  check_fields(mesh_, scene_.options(), mesh_.reference, mesh_.imaged, summary_);
}

SolveSummary BackwardSolve::run(const Eigen::VectorXd& load, const Eigen::VectorXd& start) {
  Trial state{start, scene_.assembly().rest_pressure()};
  const double reached = follow(load, state);
  conclude(state, reached);
  if (!hasty_ || summary_.converged()) store(state);
  return summary_;
}

SolveSummary BackwardSolve::run(const Vec3& gravity) {
  const Eigen::VectorXd load = scene_.gravity_force(gravity);
  Trial state{imaged_, scene_.assembly().rest_pressure()};
  const double reached = follow(load, state);
  conclude(state, reached);
  if (!summary_.converged()) {
    if (hasty_) return summary_;
    SolveSummary found = summary_;  // of the state itself; the search only adds to the clock
    const double part = stable_part(load, found.load_reached, found.stable);
    found.timer = summary_.timer;
    summary_ = std::move(found);
    if (part > 0) {
      summary_.stiffness_factor_needed = 1 / part;
      summary_.record.reason += message("; stiffnesses ", std::ceil(100 / part) / 100,
                                        " times as large would give a stable body");
    }
  }
  store(state);
  return summary_;
}

}  // namespace

SolveSummary solve_backward(HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                            Progress& progress) {
  return with_chosen_solver(3.0 * mesh.nodes(), options, progress,
                            [&](const MechanicsOptions& chosen, bool hasty) {
                              return BackwardSolve(mesh, chosen, hasty, progress).run(gravity);
                            });
}

SolveSummary solve_backward_under(HexMesh& mesh, const Eigen::VectorXd& forces,
                                  const MechanicsOptions& options, Progress& progress) {
  if (mesh.reference.size() != mesh.imaged.size() || forces.size() != 3L * mesh.nodes()) {
    throw input_error(
        "backward under given forces needs a first guess of the reference shape and 3 ",
        "numbers per node: ", mesh.reference.size(), " and ", forces.size(), " for ", mesh.nodes(),
        " nodes");
  }
  const Eigen::VectorXd start = flatten(mesh.reference);
  return with_chosen_solver(
      3.0 * mesh.nodes(), options, progress, [&](const MechanicsOptions& chosen, bool hasty) {
        return BackwardSolve(mesh, chosen, hasty, progress).run(forces, start);
      });
}

}  // namespace breast
