// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/compression.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "contact/closing_states.hpp"
#include "contact/faces.hpp"
#include "contact/failure.hpp"
#include "contact/grip.hpp"
#include "contact/results.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/load_steps.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/solution.hpp"
#include "mesh/quality.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

/// The contact solver needs a Cholesky factor.
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
  bool load_with(const Eigen::VectorXd& load, const char* name, State& state);
  bool position(State& state);
  bool lift(State& state);
  void place(const State& start);
  void set_target();
  PathOptions path_options(const ContactSolver& contact);
  bool has_let_go(const State& state);
  void close_plates(State& state);
  void record_path();
  void check_stability(const State& state, const ContactSolver& contact);
  void estimate(const State& state, const ContactSolver& contact);
  void note_stage(const char* name, const State& state);
  void say_where_plates_stand() const;
  void say_how_it_ended(const State& state);
  double load_reached() const;
  void judge_against_practice();
  void refuse_without_grip();
  void solve_states(const PathOptions& path, ContactSolver& contact);

  const HexMesh& mesh_;
  const CompressionOptions& options_;
  Progress& progress_;
  Scene scene_;
  Eigen::VectorXd load_, pull_;  // the weight; the force that a hand adds until it lets go
  LoadedProblem body_;
  SaddleSolver solver_;
  Eigen::VectorXd start_;  // the shape about which the plates stand
  CompressionTarget target_;
  CompressionResult found_;
  SolveLog log_{found_, progress_};
  int of_states_ = 0;  // factorisations of the states on the way
};

/// Loads the body alone, in steps if one step does not converge. `name` is the name of the load.
bool Compression::load_with(const Eigen::VectorXd& load, const char* name, State& state) {
  Timer::Scope phase(found_.timer, name);
  SaddleMatrix matrix = body_.problem.make_matrix();
  LoadSteps steps;
  steps.set_load = [&](double part) { body_.set_load(part * load); };
  steps.solve = [&](State& trial, double, double) -> NewtonResult {
    return equilibrate(body_.problem, solver_, matrix, trial, {}, nullptr, log_.begin_step(name));
  };
  const LoadReached reached = follow_load(steps, state);
  if (reached.whole()) return true;
  found_.reason_id = std::string(name) + "_not_carried";
  found_.load_reached = reached.part;
  found_.record.reason = message(name, " before compression stopped at ", 100 * reached.part,
                                 " % of the load: ", reached.last.reason);
  return false;
}

/// The targets of the user, or those of the clinic, for the breast as it lies between the plates.
void Compression::set_target() {
  const std::vector<Vec3>& x = mesh_.reference;
  const double projected = projected_cm2(mesh_, x, found_.plates.paddle);
  found_.stops = options_.stops.empty() ? clinical_stops(projected) : options_.stops;
  const double least_area =
      options_.plates.image_edge.has_value() ? least_pressed_cm2(projected) : 0;
  const auto target_at = [&](const CompressionStop& stop) {
    CompressionTarget target = target_of(stop, found_.plates.initial_thickness);
    if (target.kind == TargetKind::pressure) target.least_area_cm2 = least_area;
    return target;
  };
  target_ = target_at(found_.stops.front());
  for (std::size_t k = 1; k < found_.stops.size(); ++k)
    target_.or_at.push_back(target_at(found_.stops[k]));
}

/// If the breast is lifted, its weight returns while the plates grip it.
PathOptions Compression::path_options(const ContactSolver& contact) {
  PathOptions path = options_.path;
  path.control_tolerance = std::max(path.control_tolerance, contact.resolution());
  path.keep = options_.states > 0;
  if (options_.positioning == Positioning::hanging) return path;
  const Hand hand;
  if (options_.follows_breast()) {
    const double whole =
        (scene_.weight(options_.gravity) / micronewton_per_newton).dot(found_.pose.n);
    path.weight_N = [hand, whole](double way) { return hand.weight.at(way) * whole; };
  }
  path.prepare = [this, hand](double way) {
    body_.set_load(hand.weight.at(way) * load_ + (1 - hand.pull.at(way)) * pull_);
  };
  path.corners = {hand.weight.ends, hand.pull.begins, hand.pull.ends};
  std::ranges::sort(path.corners);
  path.slipping_from = hand.pull.begins;
  path.slipping_to = hand.pull.ends;
  path.may_end_from = hand.gone_from();
  return path;
}

/// Whether only the plates hold the breast at the end of the path. If a hand still does, this is
/// not a compression, and the result says so.
bool Compression::has_let_go(const State& state) {
  if (options_.positioning == Positioning::hanging) return true;
  const Hand hand;
  const double weight = hand.weight.at(found_.path.way), pull = hand.pull.at(found_.path.way);
  if (weight == 1 && (pull == 1 || !(options_.pull_N > 0))) return true;
  found_.load_reached = weight;
  const StopReason why = explain_stop(mesh_, state.x, found_.path, found_.plates);
  found_.reason_id = why.id;
  found_.record.reason = message("the compression ends at a thickness of ", found_.path.thickness,
                                 " mm, at which the hand still carries ", 100 * (1 - weight),
                                 " % of the breast's weight and pulls with ",
                                 (1 - pull) * options_.pull_N, " N: ", why.sentence);
  return false;
}

void Compression::close_plates(State& state) {
  const std::unique_ptr<ContactSolver> contact =
      make_contact_solver(options_.method, options_.friction, scene_, body_.problem, solver_);
  const std::vector<Face> faces = contact->contact_faces(mesh_);
  const auto area = [&](const State& s) {
    return touching_area(mesh_, faces, s.x, found_.plates.paddle);
  };
  const PathOptions path = path_options(*contact);
  {
    Timer::Scope phase(found_.timer, "contact");
    found_.path = follow_path(*contact, found_.plates, state, target_, area, path, progress_);
  }
  record_path();
  if (found_.path.points.empty()) {
    found_.reason_id = "no_equilibrium_at_touch";
    found_.load_reached = 0;
    found_.record.reason = message("no equilibrium with the plates just touching: ",
                                   describe(found_.path.last_failure));
    return;
  }
  if (found_.path.end == PathEnd::on_edge) {
    found_.left_with_on_edge = edge_parts(found_.path.points.back());
    return;
  }
  if (!has_let_go(state)) return;
  {
    Timer::Scope phase(found_.timer, "results");
    found_.min_det_F = found_.path.final_step.forces.min_det_F;
    record_compression(scene_, options_, state, *contact, body_.load->total(), found_);
    conclude(found_, scene_, state, options_.gravity);
    note_stage("compressed", state);
  }
  check_stability(state, *contact);
  if (scene_.options().estimate == Estimate::step) estimate(state, *contact);
  say_how_it_ended(state);
  const bool usable = found_.converged() || (found_.record.status == SolveStatus::stopped_early &&
                                             (found_.acceptable || !found_.contact->ends_image));
  if (options_.states > 0 && usable) solve_states(path, *contact);
}

/// Solves for the states on the way; the result is the last of them.
void Compression::solve_states(const PathOptions& path, ContactSolver& contact) {
  Timer::Scope phase(found_.timer, "states");
  const int factorisations = solver_.factorisations();
  found_.states = solve_closing(scene_, options_, found_, path, *body_.load, options_.states - 1,
                                contact, progress_);
  found_.states.emplace_back();
  static_cast<Equilibrium&>(found_.states.back()) = found_;
  found_.states.back().thickness = found_.path.thickness;
  of_states_ = solver_.factorisations() - factorisations;
}

/// The tangent of the final state with its touching nodes constrained, including the rotation of
/// their forces.
void Compression::check_stability(const State& state, const ContactSolver& contact) {
  Timer::Scope phase(found_.timer, "stability");
  SaddleMatrix matrix = body_.problem.make_matrix();
  Forces forces;
  found_.stable = contact.problem().tangent(state, forces, matrix) &&
                  solver_.factorise(matrix, contact.constraints(state), false).ok;
  note_solver(solver_, matrix, found_);
  if (!found_.stable) found_.doubts.push_back(unknown_stability);
}

/// Discretisation error of the final state with a fixed touching set.
void Compression::estimate(const State& state, const ContactSolver& contact) {
  const auto fixed = contact.for_estimate(mesh_, found_.plates, state);
  if (!fixed) {
    found_.error_estimate_how =
        "there is no estimate for plates that press on faces; solve with more elements and "
        "compare";
    return;
  }
  if (mesh_.order == 1 && !mesh_.landmarks.empty()) {
    Timer::Scope phase(found_.timer, "error estimate");
    SaddleMatrix matrix = body_.problem.make_matrix();
    note_estimate(estimate_error(scene_, state, options_.gravity, matrix, solver_, *fixed),
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
    log_.record(before + path.newton_step[i], path.newton[i]);
  }
  found_.steps += path.solves;
  found_.residual = path.final_step.residual;
}

void Compression::say_how_it_ended(const State& state) {
  const PathResult& path = found_.path;
  found_.record.status = path.reached() ? SolveStatus::converged : SolveStatus::stopped_early;
  if (!path.reached()) {
    const StopReason why = explain_stop(mesh_, state.x, path, found_.plates);
    found_.reason_id = why.id;
    found_.load_reached = load_reached();
    found_.record.reason =
        message("stopped at thickness ", found_.contact->thickness_mm, " mm (",
                found_.contact->reduction_percent, " % reduction): ", why.sentence);
  }
  judge_against_practice();
  if (path.reached() && options_.must_grip) refuse_without_grip();
}

/// A target that is reached without a grip, as a pressure over a few points, is no compression.
void Compression::refuse_without_grip() {
  std::string why;
  for (const Judgement& line : found_.judgement) {
    if (line.id == "contact_too_small" || line.id == "edge_carries_force")
      why += (why.empty() ? "" : "; ") + line.sentence;
  }
  if (why.empty()) return;
  found_.record.status = SolveStatus::not_gripped;
  found_.reason_id = "not_gripped";
  found_.record.reason = message("the plates do not grip the breast: ", why,
                                 ". Try another --image-edge, more force or another --turn");
}

/// Completed fraction of the path to the target.
double Compression::load_reached() const {
  return part_of_way(found_.path.points.back(), target_, found_.plates.closing_range);
}

/// Compares the result with clinical ranges, then adds comments on the path.
void Compression::judge_against_practice() {
  const ContactRecord& contact = *found_.contact;
  found_.judgement = judge_compression(
      contact, {found_.pose.n, scene_.weight(options_.gravity) / micronewton_per_newton,
                found_.wall_reaction_N, found_.max_volume_error, found_.places, found_.self_contact,
                found_.projected_cm2, found_.coverage.volume,
                mesh_quality(mesh_, found_.points).min_scaled_jacobian});
  found_.acceptable =
      contact.ends_image && std::ranges::none_of(found_.judgement, [](const Judgement& line) {
        return line.doubtful && line.decides;
      });
  for (Judgement& line : judge_path(found_.path, found_.stable)) {
    found_.judgement.push_back(std::move(line));
  }
  if (found_.path.reached()) {
    const PlateRecord& paddle = contact.plates[0];
    const PathPoint end{contact.thickness_mm, paddle.force_N, 0, paddle.mean_kPa, paddle.area_cm2};
    if (auto line = judge_target(found_.path.met, measure(end, found_.path.met)))
      found_.judgement.push_back(std::move(*line));
  }
  if (contact.reduction_percent > 40 && scene_.options().materials.name == "seed2008") {
    found_.judgement.push_back(
        {"law_stiffens",
         "beyond a reduction of 40 % the Table II laws stiffen so much that no patient would "
         "tolerate the force",
         true});
  }
  for (const Judgement& line : found_.judgement) {
    if (line.doubtful) found_.doubts.push_back(line.sentence);
  }
}

/// Brings the breast between the plates: as it hangs, or lifted by a hand that carries its weight. Then
/// the hanging shape is not needed, and for a limp breast it may not exist. Returns false if no
/// equilibrium is found.
bool Compression::position(State& state) {
  if (options_.positioning == Positioning::lifted) {
    place(state);
    return lift(state);
  }
  if (!load_with(load_, "gravity", state)) return false;
  place(state);
  note_stage("hanging", state);
  return true;
}

void Compression::place(const State& start) {
  const std::vector<Vec3> points = unflatten(start.x);
  found_.pose = place_pose(mesh_, points, options_.angle_deg, options_.plates);
  found_.plates = place_plates(mesh_, points, found_.pose, options_.plates);
  start_ = start.x;
}

void Compression::note_stage(const char* name, const State& state) {
  found_.stages.push_back(positioning_stage(name, mesh_, start_, state.x, found_.plates.paddle));
}

/// Pulls a breast that a hand has lifted forwards.
bool Compression::lift(State& state) {
  note_stage("lifted", state);
  pull_ = Eigen::VectorXd::Zero(state.x.size());
  if (!(options_.pull_N > 0)) return true;
  pull_ = pull_forwards(mesh_, mesh_.reference, found_.plates.paddle, options_.pull_N);
  if (!load_with(pull_, "pull", state)) return false;
  note_stage("pulled", state);
  return true;
}

void Compression::say_where_plates_stand() const {
  const double initial = found_.plates.initial_thickness;
  const double standoff = found_.plates.standoff;
  progress_.note(message("T0 ", initial, " mm, plates' edge ", std::abs(standoff), " mm ",
                         standoff < 0 ? "behind the front" : "in front", " of the wall, turned by ",
                         found_.pose.turn_deg, " and leaning by ", found_.pose.lean_deg,
                         " degrees, patient bent forwards by ", found_.pose.bend_deg,
                         " degrees, edge radius ", found_.plates.paddle.edge_radius, " mm"));
  for (const CompressionStop& stop : found_.stops) {
    if (stop.at != StopAt::thickness || stop.value < initial) continue;
    throw input_error("thickness ", stop.value, " mm is too large: the breast is only ", initial,
                      " mm thick between the plates; give less");
  }
}

CompressionResult Compression::run() {
  State state = scene_.at_rest(flatten(mesh_.reference));
  if (position(state)) {
    set_target();
    say_where_plates_stand();
    close_plates(state);
  }
  found_.factorisations = solver_.factorisations() - of_states_;
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
  for (const CompressionStop& stop : options.stops) {
    if (!(stop.value > 0)) {
      throw input_error("compression target ", stop.value, ": must be above 0");
    }
    if (stop.at == StopAt::reduction && !(stop.value < 100)) {
      throw input_error("reduction ", stop.value, " %: must be below 100");
    }
  }
  if (options.states < 0 || options.states == 1) {
    throw input_error("states ", options.states, ": must be at least 2, or 0 for none");
  }
  if (!(options.pull_N >= 0 && options.pull_N <= 500)) {
    throw input_error("pull ", options.pull_N, " N: must lie within 0 and 500");
  }
  if (options.pull_N > 0 && options.positioning == Positioning::hanging) {
    throw input_error(
        "pull ", options.pull_N,
        " N on a hanging breast: only a lifted breast can be pulled; give --positioning lifted");
  }
  if (!(options.friction >= 0 && options.friction <= 2)) {
    throw input_error("friction ", options.friction, ": must lie within 0 and 2");
  }
  if (options.friction > 0 && options.method == ContactMethod::augmented_lagrangian) {
    throw input_error("friction ", options.friction,
                      " with the augmented Lagrangian, which has no friction: omit --contact al");
  }
}

/// A loosely solved state with more than this part of a plate's force on its edge will not grip: that
/// takes less than 0.40, and such states differ from accurate ones by up to 0.03.
constexpr double surely_on_edge = 0.43;

/// Shares of the paddle's and the detector's force on their rounded edges.
std::array<double, 2> on_edges(const CompressionResult& found) {
  if (found.left_with_on_edge) return *found.left_with_on_edge;
  std::array<double, 2> parts{0, 0};
  for (std::size_t k = 0; k < std::min(parts.size(), found.places.size()); ++k)
    parts[k] = found.places[k].edge_part;
  return parts;
}

/// The larger of the two.
double on_edge(const CompressionResult& found) {
  return std::ranges::max(on_edges(found));
}

/// Whether a result between plates that were placed anew replaces the one before: always if it grips, and
/// a finished one replaces one that was left.
bool is_better(const CompressionResult& next, const CompressionResult& before) {
  if (next.converged()) return true;
  const bool left = next.left_with_on_edge.has_value();
  if (!left && !next.contact) return false;
  if (left != before.left_with_on_edge.has_value()) return !left;
  return on_edge(next) < on_edge(before);
}

/// Whether the edges press on the chest wall instead of the breast, so that the result is no compression.
bool presses_on_wall(const CompressionResult& found) {
  if (found.left_with_on_edge) return true;
  return !found.converged() && std::ranges::any_of(found.judgement, [](const Judgement& line) {
    return line.id == "edge_carries_force";
  });
}

/// Where the edge of the image is placed if the wall is in the way: halfway to the farthest place, and there. Nowhere else
/// if the place is given, or if the plates need not grip the breast.
std::vector<double> farther_image_edges(const CompressionOptions& options) {
  constexpr double least_mm = 1;
  const PlateOptions& plates = options.plates;
  if (!options.must_grip || plates.edge_at || !plates.image_edge || !plates.farthest_image_edge)
    return {};
  const double farthest = *plates.farthest_image_edge, way = farthest - *plates.image_edge;
  if (way < least_mm) return {};
  return {farthest - 0.5 * way, farthest};
}

/// Adds the cost of another placement of the plates. Its iterations stand before those of the result, which end the list.
void charge(const CompressionResult& other, CompressionResult& found) {
  std::vector<IterationRecord>& rows = found.record.iterations;
  for (IterationRecord& row : rows) row.step += other.steps;
  rows.insert(rows.begin(), other.record.iterations.begin(), other.record.iterations.end());
  found.steps += other.steps;
  found.newton_iterations += other.newton_iterations;
  found.linear_iterations += other.linear_iterations;
  found.factorisations += other.factorisations;
  found.path.indefinite += other.path.indefinite;
  found.path.failures += other.path.failures;
  for (const auto& [phase, seconds] : other.timer.seconds()) found.timer.add(phase, seconds);
}

/// The compression with the plates at another place; nothing if they would miss the breast there.
std::optional<CompressionResult> placed_anew(const HexMesh& mesh, const CompressionOptions& options,
                                             const MechanicsOptions& mechanics,
                                             Progress& progress) {
  try {
    return Compression(mesh, options, mechanics, progress).run();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::input) return {};
    throw;
  }
}

/// The options with the angle by which the patient bends forwards, and gravity in her frame; `options.gravity` is that of a
/// patient who stands upright.
CompressionOptions bent(const HexMesh& mesh, CompressionOptions options) {
  const ViewPose pose = place_pose(mesh, mesh.reference, options.angle_deg, options.plates);
  options.plates.bend_deg = pose.bend_deg;
  options.gravity = turned_by_bend(pose, options.gravity);
  return options;
}

/// Where the plates stand and how far the patient bends forwards: what changes from one placement to the next.
struct Stance {
  std::optional<double> image_edge, bend_deg;
};

}  // namespace

CompressionResult compress(const HexMesh& mesh, const CompressionOptions& options,
                           const MechanicsOptions& mechanics, Progress& progress) {
  check(mesh, options, mechanics);
  CompressionOptions first = bent(mesh, options);
  const std::vector<double> farther = farther_image_edges(first);
  if (!farther.empty()) first.path.most_on_edge = surely_on_edge;
  CompressionResult found = Compression(mesh, first, mechanics, progress).run();
  Stance best{first.plates.image_edge, first.plates.bend_deg};
  const auto place_at = [&](const Stance& stance, double most_on_edge) {
    CompressionOptions placed = options;
    placed.plates.image_edge = stance.image_edge;
    placed.plates.bend_deg = stance.bend_deg;
    placed.path.most_on_edge = most_on_edge;
    return placed_anew(mesh, bent(mesh, std::move(placed)), mechanics, progress);
  };
  bool search = presses_on_wall(found);
  for (const double image_edge : farther) {
    if (!search) break;
    Stance stance{image_edge, best.bend_deg};
    if (!options.plates.bend_deg)
      stance.bend_deg = balanced_bend_deg(*best.bend_deg, on_edges(found));
    progress.note(message("the plates' edge carries ", std::round(100 * on_edge(found)),
                          " % of a plate's force: the plates are placed anew, their edge ",
                          image_edge - *first.plates.image_edge,
                          " mm farther from the wall than at first, the patient bent forwards by ",
                          *stance.bend_deg, " degrees"));
    const bool last = image_edge == farther.back();
    std::optional<CompressionResult> next =
        place_at(stance, last ? options.path.most_on_edge : surely_on_edge);
    if (!next) break;
    search = !next->converged();
    const int placements = found.placements + 1;
    if (is_better(*next, found)) {
      std::swap(*next, found);
      best = stance;
    }
    charge(*next, found);
    found.placements = placements;
  }
  if (!found.left_with_on_edge) return found;
  // No other place gave a result: this one is finished.
  std::optional<CompressionResult> finished = place_at(best, options.path.most_on_edge);
  if (!finished) return found;
  charge(found, *finished);
  finished->placements = found.placements + 1;
  return std::move(*finished);
}

}  // namespace breast
