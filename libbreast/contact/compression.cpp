#include "contact/compression.hpp"

#include <chrono>
#include <cmath>
#include <memory>
#include <optional>

#include "contact/active_set.hpp"
#include "contact/augmented_lagrangian.hpp"
#include "contact/failure.hpp"
#include "contact/results.hpp"
#include "contact/saddle_body.hpp"
#include "contact/skin_area.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/error_estimate.hpp"
#include "mechanics/field_checks.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"

namespace breast {

namespace {

/// In units of shear modulus times element size: the penalty of the augmented Lagrangian, and the
/// springs that stand for sticking friction (at 10 kPa and μ = 0.3 they give by about 0.2 mm).
constexpr double penalty_factor = 10, stick_factor = 100;

class Compression {
 public:
  Compression(HexMesh& mesh, const CompressionOptions& options, const MechanicsOptions& mechanics,
              Progress& progress)
      : mesh_(mesh),
        options_(options),
        progress_(progress),
        scene_(mesh, mechanics),
        reference_(flatten(mesh.reference)),
        load_(scene_.gravity_force(options.gravity)),
        body_(scene_, reference_, load_),
        held_(scene_.walls()),
        solver_(body_.pattern()) {
    if (!options.wall) return;
    wall_.emplace(mesh, *options.wall);
    on_wall_.emplace(body_, *wall_);
    for (const int node : nodes_of(mesh, mesh.pectoral_faces)) held_.release(node);
    if (mechanics.cut == Cut::free) return;
    const Constraints cut = wall_constraints(mesh, mechanics.cut);
    for (const int node : nodes_of(mesh, mesh.cut_faces)) {
      if (cut.at(node) != nullptr) held_.set(node, *cut.at(node));
    }
  }

  CompressionSummary run();

 private:
  bool load_with_gravity(SaddleState& state);
  std::vector<int> candidates() const;
  /// The body, on its elastic wall when it has one.
  const SaddleProblem& problem() const {
    return on_wall_ ? static_cast<const SaddleProblem&>(*on_wall_) : body_;
  }
  Vec3 weight() const;
  double nodal_stiffness() const;
  std::unique_ptr<ContactSolver> contact_solver(ContactBody& body) const;
  CompressionTarget target() const;
  void close_plates(SaddleState& state);
  void record_path();
  void estimate(const BodyState& at, const ContactSolver& contact);
  void conclude(const BodyState& state);
  double load_reached() const;
  void judge();
  double clock() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  HexMesh& mesh_;
  const CompressionOptions& options_;
  Progress& progress_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Scene scene_;
  Eigen::VectorXd reference_, load_;
  ForwardProblem body_;
  std::optional<ElasticWall> wall_;
  std::optional<ProblemOnWall> on_wall_;
  Constraints held_;
  SaddleSolver solver_;
  CompressionSummary summary_;
};

/// Gravity alone, in load steps when one does not converge.
bool Compression::load_with_gravity(SaddleState& state) {
  Timer::Scope phase(summary_.timer, "gravity");
  SaddleMatrix matrix = problem().make_matrix();
  LoadPath path;
  while (!path.finished()) {
    body_.set_load(path.next() * load_);
    SaddleState trial = state;
    ++summary_.steps;
    const NewtonResult result =
        newton(problem(), solver_, matrix, held_, nullptr, trial, {},
               [&](const NewtonIteration& iteration) {
                 record_iteration(summary_, summary_.steps, iteration, clock());
                 progress_.update("gravity", -1, message("residual ", iteration.residual));
               });
    if (result.converged) {
      state = std::move(trial);
      path.succeed();
    } else if (!path.fail()) {
      summary_.record.status = "not_converged";
      summary_.reason_id = "gravity_not_carried";
      summary_.load_reached = path.done;
      summary_.record.reason = message("gravity before compression stopped at ", 100 * path.done,
                                       " % of the load: ", result.reason);
      return false;
    }
  }
  return true;
}

Vec3 Compression::weight() const {
  Vec3 sum = Vec3::Zero();
  for (Eigen::Index i = 0; i < load_.size(); i += 3) sum += load_.segment<3>(i);
  return sum;
}

/// Skin nodes that nothing holds.
std::vector<int> Compression::candidates() const {
  std::vector<int> list;
  for (const int node : nodes_of(mesh_, mesh_.skin_faces)) {
    if (scene_.walls().at(node) == nullptr) list.push_back(node);
  }
  return list;
}

/// Shear modulus times element size: what a node resists with, µN/mm.
double Compression::nodal_stiffness() const {
  double stiffest = 0, volume = 0;
  for (const double v : scene_.assembly().imaged_volume()) volume += v;
  for (const Tissue tissue : mesh_.tissue) {
    stiffest = std::max(stiffest, scene_.options().materials.law(tissue).shear_modulus());
  }
  return stiffest * std::cbrt(volume / mesh_.elements());
}

std::unique_ptr<ContactSolver> Compression::contact_solver(ContactBody& body) const {
  if (options_.method == ContactMethod::active_set) {
    ActiveSetOptions exact;
    exact.friction = {options_.friction, stick_factor * nodal_stiffness()};
    if (exact.friction.present()) exact.max_iterations *= 2;  // bounds are followed linearly
    return std::make_unique<ActiveSet>(body, candidates(), exact);
  }
  AugmentedLagrangianOptions al;
  al.penalty = penalty_factor * nodal_stiffness();
  return std::make_unique<AugmentedLagrangian>(body, candidates(), al);
}

CompressionTarget Compression::target() const {
  const double initial = summary_.plates.initial_thickness;
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

void Compression::close_plates(SaddleState& state) {
  SaddleBody body(problem(), solver_, held_, weight());
  const std::unique_ptr<ContactSolver> contact = contact_solver(body);
  BodyState at{std::move(state.u), std::move(state.p)};
  const auto area = [&](const BodyState& s) {
    const std::vector<double> all = skin_area_per_node(mesh_, s.x);
    std::vector<double> own;
    for (const int node : contact->candidates()) own.push_back(all[std::size_t(node)]);
    return own;
  };
  {
    Timer::Scope phase(summary_.timer, "contact");
    summary_.path =
        follow_path(*contact, summary_.plates, at, target(), area, options_.path, progress_);
  }
  record_path();
  if (summary_.path.points.empty()) {
    summary_.record.status = "not_converged";
    summary_.reason_id = "no_equilibrium_at_touch";
    summary_.load_reached = 0;
    summary_.record.reason = message("no equilibrium with the plates just touching: ",
                                     describe(summary_.path.last_failure));
    return;
  }
  Timer::Scope phase(summary_.timer, "results");
  const Vec3 wall = wall_ ? wall_->force_on_body(at.x) : Vec3::Zero();
  record_compression(mesh_, options_, at, body, *contact, wall, summary_);
  mesh_.det_F = scene_.assembly().mean_det_f(reference_, at.x);
  mesh_.pressure = scene_.assembly().mean_pressure(at.p);
  check_fields(mesh_, scene_.options(), mesh_.reference, mesh_.points, summary_);
  if (scene_.options().estimate == Estimate::step) estimate(at, *contact);
  conclude(at);
}

/// Discretisation error of the final state, the touching set held.
void Compression::estimate(const BodyState& at, const ContactSolver& contact) {
  // The richer problem knows neither friction nor springs.
  if (mesh_.order == 1 && !mesh_.landmarks.empty() && !wall_ && !(options_.friction > 0)) {
    Timer::Scope phase(summary_.timer, "error estimate");
    std::vector<TouchingNode> touching;
    for (std::size_t c = 0; c < contact.candidates().size(); ++c) {
      const int node = contact.candidates()[c], plate = contact.touching()[c];
      if (plate < 0) continue;
      const Gap gap = summary_.plates.plate(plate).gap(at.x.segment<3>(3 * node));
      touching.push_back({node, plate, gap.gradient});
    }
    SaddleMatrix matrix = problem().make_matrix();
    const ErrorEstimate error = estimate_error(scene_, reference_, {at.x, at.p}, options_.gravity,
                                               matrix, solver_, touching);
    if (error.usable) {
      summary_.error_estimate_mm = error.worst_mm;
      summary_.landmark_error_mm = error.landmarks;
      summary_.error_estimate_how =
          message(error.how(),
                  ", nodes on the plates held along their normals: discretisation only, not "
                  "geometry, labels or laws");
      return;
    }
  }
  summary_.doubts.push_back("discretisation error of the compressed shape not estimated");
}

void Compression::record_path() {
  const PathResult& path = summary_.path;
  for (std::size_t i = 0; i < path.newton.size(); ++i) {
    const NewtonRecord& newton = path.newton[i];
    IterationRecord record;
    record.step = summary_.steps + path.newton_step[i];
    record.iteration = ++summary_.newton_iterations;
    record.residual = newton.residual;
    record.min_det_F = newton.min_det_F;
    record.max_det_F = newton.max_det_F;
    record.step_length = newton.step_length;
    record.seconds = clock();
    summary_.record.iterations.push_back(record);
  }
  summary_.steps += path.solves;
  summary_.residual = path.final_step.residual;
}

void Compression::conclude(const BodyState& state) {
  const PathResult& path = summary_.path;
  summary_.record.status = path.reached ? "converged" : "stopped_early";
  if (!path.reached) {
    const StopReason why = explain_stop(mesh_, state.x, path, summary_.plates);
    summary_.reason_id = why.id;
    summary_.load_reached = load_reached();
    summary_.record.reason = message("stopped at thickness ", summary_.thickness_mm, " mm (",
                                     summary_.reduction_percent, " % reduction): ", why.sentence);
  }
  summary_.min_det_F = path.final_step.forces.min_det_F;
  summary_.max_volume_error = path.final_step.forces.max_volume_error;
  summary_.unknowns = scene_.unknowns();
  judge();
}

/// Part of the way to the target.
double Compression::load_reached() const {
  const CompressionTarget wanted = target();
  const PathPoint& end = summary_.path.points.back();
  if (wanted.kind == TargetKind::force) return end.paddle_N / wanted.value;
  if (wanted.kind == TargetKind::pressure) return end.pressure_kPa / wanted.value;
  const double initial = summary_.initial_thickness_mm;
  return (initial - summary_.thickness_mm) / (initial - wanted.value);
}

/// The result against clinical ranges, then how it was found.
void Compression::judge() {
  const PathResult& path = summary_.path;
  summary_.judgement = judge_compression(
      *mesh_.contact,
      {view_pose(mesh_.side, options_.angle_deg).n, weight() / micronewton_per_newton,
       summary_.wall_reaction_N, summary_.max_volume_error, summary_.places});
  if (path.first_indefinite_thickness) {
    summary_.judgement.push_back(
        {"slips_or_buckles",
         message("the tangent was indefinite in ", path.indefinite,
                 " iterations, first at thickness ", *path.first_indefinite_thickness,
                 " mm: the breast slips or buckles there"),
         true});
  }
  if (summary_.reduction_percent > 40 && scene_.options().materials.name == "seed2008") {
    summary_.judgement.push_back(
        {"law_stiffens",
         "the Table II laws stiffen beyond 40 % reduction to forces no patient bears", true});
  }
  for (const Judgement& line : summary_.judgement) {
    if (line.doubtful) summary_.doubts.push_back(line.sentence);
  }
}

CompressionSummary Compression::run() {
  SaddleState state{reference_, scene_.assembly().rest_pressure()};
  if (load_with_gravity(state)) {
    summary_.plates = place_plates(mesh_, unflatten(state.u),
                                   view_pose(mesh_.side, options_.angle_deg), options_.plates);
    const double initial = summary_.plates.initial_thickness;
    progress_.note(message("T0 ", initial, " mm, stand-off ", summary_.plates.standoff,
                           " mm, edge radius ", summary_.plates.paddle.edge_radius, " mm"));
    if (options_.stop_at == StopAt::thickness && !(options_.target < initial)) {
      throw input_error("thickness ", options_.target, " mm: the breast is only ", initial,
                        " mm thick between the plates; give less");
    }
    close_plates(state);
  }
  summary_.factorisations = solver_.factorisations();
  mesh_.solve = summary_.record;
  return std::move(summary_);
}

}  // namespace

CompressionSummary compress(HexMesh& mesh, const CompressionOptions& options,
                            const MechanicsOptions& mechanics, Progress& progress) {
  if (mechanics.solver == "multigrid") {
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
                      " with the augmented Lagrangian: only the active set has friction");
  }
  return Compression(mesh, options, mechanics, progress).run();
}

}  // namespace breast
