#include "contact/compression.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>

#include "contact/estimate_plates.hpp"
#include "contact/failure.hpp"
#include "contact/penetration.hpp"
#include "contact/results.hpp"
#include "contact/skin_area.hpp"
#include "contact/solvers/active_set.hpp"
#include "contact/solvers/augmented_lagrangian.hpp"
#include "contact/solvers/surface_contact.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

/// In units of shear modulus times element size: the penalty of the augmented Lagrangian, and the
/// springs that stand for sticking friction (at 10 kPa and μ = 0.3 they give by about 0.2 mm).
constexpr double penalty_factor = 10, stick_factor = 100;

/// A lifted breast has its whole weight again at this reduction, and the first of it at this fraction
/// of that. Where a force or a pressure ends the path its reduction is not known beforehand.
constexpr double weight_is_whole = 0.25, weight_is_whole_in_control = 0.1, weight_begins = 0.2;

/// The contact solver needs a factor.
MechanicsOptions by_factor(MechanicsOptions mechanics) {
  mechanics.solver = SolverOption::direct;
  return mechanics;
}

class Compression {
 public:
  Compression(const HexMesh& mesh, const CompressionOptions& options,
              const MechanicsOptions& mechanics, Progress& progress)
      : mesh_(mesh),
        options_(options),
        progress_(progress),
        scene_(mesh, by_factor(mechanics)),
        load_(scene_.gravity_force(options.gravity)),
        body_(scene_.problem(load_)),
        solver_(scene_.solid().space()->pattern) {}

  CompressionResult run();

 private:
  bool load_with_gravity(State& state);
  std::vector<int> candidates() const;
  Friction friction_of_plates() const {
    return {options_.friction, stick_factor * scene_.stiffest() * scene_.element_size()};
  }
  std::unique_ptr<ActiveSet> active_set();
  std::unique_ptr<ContactSolver> augmented_lagrangian();
  CompressionTarget target() const;
  void place(State& state);
  PathOptions path_options();
  void close_plates(State& state);
  void record_path();
  void check_stability(const State& state, const ContactSolver& contact);
  void estimate(const State& state, const ContactSolver& contact,
                const std::shared_ptr<FrictionTerm>& friction);
  void say_how_it_ended(const State& state);
  double load_reached() const;
  void judge_against_practice();
  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  const HexMesh& mesh_;
  const CompressionOptions& options_;
  Progress& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Scene scene_;
  Eigen::VectorXd load_;
  LoadedProblem body_;
  SaddleSolver solver_;
  const SurfaceContact* surface_ = nullptr;  // where faces touch: the solver
  CompressionResult found_;
};

/// Gravity alone, in load steps when one does not converge.
bool Compression::load_with_gravity(State& state) {
  Timer::Scope phase(found_.timer, "gravity");
  SaddleMatrix matrix = body_.problem.make_matrix();
  LoadPath path;
  while (!path.finished()) {
    body_.set_load(path.next() * load_);
    State trial = state;
    ++found_.steps;
    const EquilibriumResult result = equilibrate(
        body_.problem, solver_, matrix, trial, {}, nullptr, [&](const NewtonIteration& iteration) {
          record_iteration(found_, found_.steps, iteration, clock());
          progress_.update("gravity", -1, message("residual ", iteration.residual));
        });
    if (result.converged) {
      state = std::move(trial);
      path.succeed();
    } else if (!path.fail()) {
      found_.reason_id = "gravity_not_carried";
      found_.load_reached = path.done;
      found_.record.reason = message("gravity before compression stopped at ", 100 * path.done,
                                     " % of the load: ", result.reason);
      return false;
    }
  }
  return true;
}

/// Skin nodes that nothing holds and that are not on the chest wall.
std::vector<int> Compression::candidates() const {
  const std::vector<int> wall = nodes_of(mesh_, mesh_.pectoral_faces);
  const std::set<int> on_wall(wall.begin(), wall.end());
  std::vector<int> list;
  for (const int node : nodes_of(mesh_, mesh_.skin_faces)) {
    if (scene_.walls().at(node) == nullptr && !on_wall.contains(node)) list.push_back(node);
  }
  return list;
}

std::unique_ptr<ActiveSet> Compression::active_set() {
  ActiveSetOptions exact;
  exact.friction = friction_of_plates();
  if (exact.friction.present()) exact.max_iterations *= 2;  // bounds are followed linearly
  return std::make_unique<ActiveSet>(body_.problem, solver_, candidates(), exact);
}

std::unique_ptr<ContactSolver> Compression::augmented_lagrangian() {
  AugmentedLagrangianOptions al;
  al.penalty = penalty_factor * scene_.stiffest() * scene_.element_size();
  return std::make_unique<AugmentedLagrangian>(body_.problem, solver_, candidates(), al);
}

CompressionTarget Compression::target() const {
  const double initial = found_.plates.initial_thickness;
  switch (options_.stop_at) {
    case StopAt::thickness:
      return {TargetKind::thickness, options_.target};
    case StopAt::reduction:
      return {TargetKind::thickness, initial * (1 - options_.target / 100)};
    case StopAt::force:
      return {TargetKind::force, options_.target};
    case StopAt::pressure:
      return {TargetKind::pressure, options_.target};
  }
  return {};
}

/// Where the breast is lifted its weight comes back while the plates grip it.
PathOptions Compression::path_options() {
  PathOptions path = options_.path;
  if (options_.positioning == Positioning::hanging) return path;
  const double initial = found_.plates.initial_thickness;
  const CompressionTarget end = target();
  const double whole = end.kind == TargetKind::thickness
                           ? std::min(weight_is_whole, 0.5 * (1 - end.value / initial))
                           : weight_is_whole_in_control;
  path.prepare = [this, initial, whole](double thickness) {
    const double reduction = 1 - thickness / initial;
    const double begun = weight_begins * whole;
    body_.set_load(std::clamp((reduction - begun) / (whole - begun), 0.0, 1.0) * load_);
  };
  return path;
}

void Compression::close_plates(State& state) {
  std::shared_ptr<FrictionTerm> friction;
  std::unique_ptr<ContactSolver> contact;
  if (options_.method == ContactMethod::surface) {
    SurfaceContactOptions stiff;
    stiff.friction = friction_of_plates();
    auto faces = std::make_unique<SurfaceContact>(mesh_, touchable_faces(mesh_), body_.problem,
                                                  solver_, stiff);
    surface_ = faces.get();
    contact = std::move(faces);
  } else if (options_.method == ContactMethod::active_set) {
    auto exact = active_set();
    friction = exact->friction();
    contact = std::move(exact);
  } else {
    contact = augmented_lagrangian();
  }
  const auto area = [&](const State& s) {
    const std::vector<double> all = skin_area_per_node(mesh_, s.x);
    std::vector<double> own;
    for (const int node : contact->candidates()) own.push_back(all[std::size_t(node)]);
    return own;
  };
  {
    Timer::Scope phase(found_.timer, "contact");
    found_.path =
        follow_path(*contact, found_.plates, state, target(), area, path_options(), progress_);
  }
  record_path();
  if (found_.path.points.empty()) {
    found_.reason_id = "no_equilibrium_at_touch";
    found_.load_reached = 0;
    found_.record.reason = message("no equilibrium with the plates just touching: ",
                                   describe(found_.path.last_failure));
    return;
  }
  {
    Timer::Scope phase(found_.timer, "results");
    found_.min_det_F = found_.path.final_step.forces.min_det_F;
    record_compression(scene_, options_, state, *contact, surface_, body_.load->total(), found_);
    conclude(found_, scene_, state, options_.gravity);
  }
  check_stability(state, *contact);
  if (scene_.options().estimate == Estimate::step) estimate(state, *contact, friction);
  say_how_it_ended(state);
}

/// The tangent of the final state with its touching nodes held, the turning
/// of their forces included.
void Compression::check_stability(const State& state, const ContactSolver& contact) {
  Timer::Scope phase(found_.timer, "stability");
  SaddleMatrix matrix = body_.problem.make_matrix();
  Forces forces;
  found_.stable = contact.problem().tangent(state, forces, matrix) &&
                  solver_.factorise(matrix, contact.constraints(state), false).ok;
  note_solver(solver_, matrix, found_);
  if (!found_.stable) found_.doubts.push_back(unknown_stability);
}

/// Discretisation error of the final state, the touching set held.
void Compression::estimate(const State& state, const ContactSolver& contact,
                           const std::shared_ptr<FrictionTerm>& friction) {
  if (mesh_.order == 1 && !mesh_.landmarks.empty()) {
    Timer::Scope phase(found_.timer, "error estimate");
    const ContactEstimate plates =
        surface_ != nullptr ? estimate_of_faces(*surface_, state)
                            : estimate_of_nodes(contact, found_.plates, friction, mesh_, state);
    SaddleMatrix matrix = body_.problem.make_matrix();
    note_estimate(estimate_error(scene_, state, options_.gravity, matrix, solver_, plates),
                  ", nodes on the plates held along their normals", found_);
  }
  if (found_.error_estimate_mm < 0) {
    found_.doubts.push_back("discretisation error of the compressed shape not estimated");
  }
}

void Compression::record_path() {
  const PathResult& path = found_.path;
  const int before = found_.steps;
  for (std::size_t i = 0; i < path.newton.size(); ++i) {
    record_iteration(found_, before + path.newton_step[i], path.newton[i], clock());
  }
  found_.steps += path.solves;
  found_.residual = path.final_step.residual;
}

void Compression::say_how_it_ended(const State& state) {
  const PathResult& path = found_.path;
  found_.record.status = path.reached ? SolveStatus::converged : SolveStatus::stopped_early;
  if (!path.reached) {
    const StopReason why = explain_stop(mesh_, state.x, path, found_.plates);
    found_.reason_id = why.id;
    found_.load_reached = load_reached();
    found_.record.reason = message("stopped at thickness ", found_.thickness_mm, " mm (",
                                   found_.reduction_percent, " % reduction): ", why.sentence);
  }
  judge_against_practice();
}

/// Fraction of the way to the target.
double Compression::load_reached() const {
  const CompressionTarget wanted = target();
  const PathPoint& end = found_.path.points.back();
  if (wanted.kind == TargetKind::force) return end.paddle_N / wanted.value;
  if (wanted.kind == TargetKind::pressure) return end.pressure_kPa / wanted.value;
  const double initial = found_.initial_thickness_mm;
  return (initial - found_.thickness_mm) / (initial - wanted.value);
}

/// The result against clinical ranges, then how it was found.
void Compression::judge_against_practice() {
  const PathResult& path = found_.path;
  found_.judgement = judge_compression(
      *found_.contact, {found_.pose.n, body_.load->total() / micronewton_per_newton,
                        found_.wall_reaction_N, found_.max_volume_error, found_.places});
  if (path.first_indefinite_thickness) {
    found_.judgement.push_back(
        {"slips_or_buckles",
         message("the tangent was indefinite in ", path.indefinite,
                 " iterations, first at thickness ", *path.first_indefinite_thickness,
                 " mm: the breast slips or buckles there"),
         true});
  }
  if (path.jump) {
    found_.judgement.push_back(
        {"jump_at_target",
         message("jump at target: between plate positions 0.1 micrometre apart the ",
                 options_.stop_at == StopAt::force ? "paddle force" : "mean pressure",
                 " goes from ", path.jump->first, " to ", path.jump->second, ", past ",
                 options_.target, "; the nearer one is the result"),
         true});
  }
  if (found_.reduction_percent > 40 && scene_.options().materials.name == "seed2008") {
    found_.judgement.push_back(
        {"law_stiffens",
         "the Table II laws stiffen beyond 40 % reduction to forces no patient bears", true});
  }
  for (const Judgement& line : found_.judgement) {
    if (line.doubtful) found_.doubts.push_back(line.sentence);
  }
}

/// Places the plates about the upright breast. One that is lifted takes on its stress-free shape,
/// and there the plates begin.
void Compression::place(State& state) {
  const std::vector<Vec3> upright = unflatten(state.x);
  const double turn = options_.plates.turn_deg.value_or(wall_turn_deg(mesh_, upright));
  found_.pose = view_pose(mesh_.side, options_.angle_deg, turn);
  found_.plates = place_plates(mesh_, upright, found_.pose, options_.plates);
  if (options_.positioning == Positioning::lifted) {
    state = scene_.at_rest(flatten(mesh_.reference));
    found_.plates = start_from(found_.plates, mesh_, mesh_.reference, found_.pose, options_.plates);
  }
  const double initial = found_.plates.initial_thickness;
  progress_.note(message("T0 ", initial, " mm, plates' edge ", found_.plates.standoff,
                         " mm in front of the wall and turned by ", turn, " degrees, edge radius ",
                         found_.plates.paddle.edge_radius, " mm"));
  if (options_.stop_at == StopAt::thickness && !(options_.target < initial)) {
    throw input_error("thickness ", options_.target, " mm: the breast is only ", initial,
                      " mm thick between the plates; give less");
  }
}

CompressionResult Compression::run() {
  State state = scene_.at_rest(flatten(mesh_.reference));
  if (load_with_gravity(state)) {
    place(state);
    close_plates(state);
  }
  found_.factorisations = solver_.factorisations();
  return std::move(found_);
}

void check(const HexMesh& mesh, const CompressionOptions& options,
           const MechanicsOptions& mechanics) {
  if (mechanics.solver == SolverOption::multigrid) {
    throw input_error("--solver multigrid is not available for compression: use auto or direct");
  }
  if (mesh.reference.size() != mesh.points.size()) {
    throw input_error("mesh: no stress-free reference shape; run backward first");
  }
  if (!(options.target > 0)) {
    throw input_error("compression target ", options.target, ": must be above 0");
  }
  if (options.stop_at == StopAt::reduction && !(options.target < 100)) {
    throw input_error("reduction ", options.target, " %: must be below 100");
  }
  if (!(options.friction >= 0 && options.friction <= 2)) {
    throw input_error("friction ", options.friction, ": must lie within 0 and 2");
  }
  if (options.friction > 0 && options.method == ContactMethod::augmented_lagrangian) {
    throw input_error("friction ", options.friction,
                      " with the augmented Lagrangian: it has none; leave --contact al out");
  }
}

}  // namespace

CompressionResult compress(const HexMesh& mesh, const CompressionOptions& options,
                           const MechanicsOptions& mechanics, Progress& progress) {
  check(mesh, options, mechanics);
  return Compression(mesh, options, mechanics, progress).run();
}

}  // namespace breast
