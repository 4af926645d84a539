// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/placed_compression.hpp"

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

}  // namespace

PlacedCompression::PlacedCompression(const HexMesh& mesh, CompressionOptions options,
                                     const MechanicsOptions& mechanics, Progress& progress)
    : mesh_(mesh),
      options_(std::move(options)),
      progress_(progress),
      scene_(mesh, by_factor(mechanics)),
      load_(scene_.gravity_force(options_.gravity)),
      body_(scene_.problem(load_)),
      solver_(scene_.solid().space()->pattern) {}

/// Loads the body alone, in steps if one step does not converge. `name` is the name of the load.
bool PlacedCompression::load_with(const Eigen::VectorXd& load, const char* name) {
  Timer::Scope phase(found_.timer, name);
  SaddleMatrix matrix = body_.problem.make_matrix();
  LoadSteps steps;
  steps.set_load = [&](double part) { body_.set_load(part * load); };
  steps.solve = [&](State& trial, double, double) -> NewtonResult {
    return equilibrate(body_.problem, solver_, matrix, trial, {}, nullptr, log_.begin_step(name));
  };
  const LoadReached reached = follow_load(steps, state_);
  if (reached.whole()) return true;
  found_.reason_id = std::string(name) + "_not_carried";
  found_.load_reached = reached.part;
  found_.record.reason = message(name, " before compression stopped at ", 100 * reached.part,
                                 " % of the load: ", reached.last.reason);
  return false;
}

/// The targets of the user, or those of the clinic, for the breast as it lies between the plates.
void PlacedCompression::set_target() {
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
PathOptions PlacedCompression::path_options() {
  PathOptions path = options_.path;
  path.control_tolerance = std::max(path.control_tolerance, contact_->resolution());
  path.most_iterations -= found_.newton_iterations;
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
bool PlacedCompression::has_let_go() {
  if (options_.positioning == Positioning::hanging) return true;
  const Hand hand;
  const double weight = hand.weight.at(found_.path.way), pull = hand.pull.at(found_.path.way);
  if (weight == 1 && (pull == 1 || !(options_.pull_N > 0))) return true;
  found_.load_reached = weight;
  const StopReason why = explain_stop(mesh_, state_.x, found_.path, found_.plates);
  found_.reason_id = why.id;
  found_.record.reason = message("the compression ends at a thickness of ", found_.path.thickness,
                                 " mm, at which the hand still carries ", 100 * (1 - weight),
                                 " % of the breast's weight and pulls with ",
                                 (1 - pull) * options_.pull_N, " N: ", why.sentence);
  return false;
}

void PlacedCompression::close_plates() {
  contact_ =
      make_contact_solver(options_.method, options_.friction, scene_, body_.problem, solver_);
  const auto area = [this, faces = contact_->contact_faces(mesh_)](const State& s) {
    return touching_area(mesh_, faces, s.x, found_.plates.paddle);
  };
  path_ = path_options();
  way_ = std::make_unique<ClosingPath>(*contact_, found_.plates, target_, area, path_, progress_);
  conclude_path([&] { return way_->follow(state_); });
}

void PlacedCompression::conclude_path(const std::function<PathResult()>& follow) {
  {
    Timer::Scope phase(found_.timer, "contact");
    found_.path = follow();
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
  if (!has_let_go()) return;
  {
    Timer::Scope phase(found_.timer, "results");
    found_.min_det_F = found_.path.final_step.forces.min_det_F;
    record_compression(scene_, options_, state_, *contact_, body_.load->total(), found_);
    conclude(found_, scene_, state_, options_.gravity);
    note_stage("compressed");
  }
  check_stability();
  if (scene_.options().estimate == Estimate::step) estimate();
  say_how_it_ended();
  const bool usable = found_.converged() || (found_.record.status == SolveStatus::stopped_early &&
                                             (found_.acceptable || !found_.contact->ends_image));
  if (options_.states > 0 && usable) solve_states();
}

/// Solves for the states on the way; the result is the last of them.
void PlacedCompression::solve_states() {
  Timer::Scope phase(found_.timer, "states");
  const int factorisations = solver_.factorisations();
  found_.states = solve_closing(scene_, options_, found_, path_, *body_.load, options_.states - 1,
                                *contact_, progress_);
  found_.states.emplace_back();
  static_cast<Equilibrium&>(found_.states.back()) = found_;
  found_.states.back().thickness = found_.path.thickness;
  of_states_ = solver_.factorisations() - factorisations;
}

/// The tangent of the final state with its touching nodes constrained, including the rotation of
/// their forces.
void PlacedCompression::check_stability() {
  Timer::Scope phase(found_.timer, "stability");
  SaddleMatrix matrix = body_.problem.make_matrix();
  Forces forces;
  found_.stable = contact_->problem().tangent(state_, forces, matrix) &&
                  solver_.factorise(matrix, contact_->constraints(state_), false).ok;
  note_solver(solver_, matrix, found_);
  if (!found_.stable) found_.doubts.push_back(unknown_stability);
}

/// Discretisation error of the final state with a fixed touching set.
void PlacedCompression::estimate() {
  const auto fixed = contact_->for_estimate(mesh_, found_.plates, state_);
  if (!fixed) {
    found_.error_estimate_how =
        "there is no estimate for plates that press on faces; solve with more elements and "
        "compare";
    return;
  }
  if (mesh_.order == 1 && !mesh_.landmarks.empty()) {
    Timer::Scope phase(found_.timer, "error estimate");
    SaddleMatrix matrix = body_.problem.make_matrix();
    note_estimate(estimate_error(scene_, state_, options_.gravity, matrix, solver_, *fixed),
                  ", nodes on the plates held along their normals", found_);
  }
  if (found_.error_estimate_mm < 0) {
    found_.doubts.push_back("discretisation error of the compressed shape not estimated");
  }
}

void PlacedCompression::record_path() {
  const PathResult& path = found_.path;
  const int before = found_.steps - recorded_solves_;
  for (; recorded_iterations_ < path.newton.size(); ++recorded_iterations_) {
    log_.record(before + path.newton_step[recorded_iterations_], path.newton[recorded_iterations_]);
  }
  found_.steps = before + path.solves;
  recorded_solves_ = path.solves;
  found_.residual = path.final_step.residual;
}

void PlacedCompression::say_how_it_ended() {
  const PathResult& path = found_.path;
  found_.record.status = path.reached() ? SolveStatus::converged : SolveStatus::stopped_early;
  if (!path.reached()) {
    const StopReason why = explain_stop(mesh_, state_.x, path, found_.plates);
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
void PlacedCompression::refuse_without_grip() {
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
double PlacedCompression::load_reached() const {
  return part_of_way(found_.path.points.back(), target_, found_.plates.closing_range);
}

/// Compares the result with clinical ranges, then adds comments on the path.
void PlacedCompression::judge_against_practice() {
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
bool PlacedCompression::position() {
  if (options_.positioning == Positioning::lifted) {
    place();
    return lift();
  }
  if (!load_with(load_, "gravity")) return false;
  place();
  note_stage("hanging");
  return true;
}

void PlacedCompression::place() {
  const std::vector<Vec3> points = unflatten(state_.x);
  found_.pose = place_pose(mesh_, points, options_.angle_deg, options_.plates);
  found_.plates = place_plates(mesh_, points, found_.pose, options_.plates);
  start_ = state_.x;
}

void PlacedCompression::note_stage(const char* name) {
  found_.stages.push_back(positioning_stage(name, mesh_, start_, state_.x, found_.plates.paddle));
}

/// Pulls a breast that a hand has lifted forwards.
bool PlacedCompression::lift() {
  note_stage("lifted");
  pull_ = Eigen::VectorXd::Zero(state_.x.size());
  if (!(options_.pull_N > 0)) return true;
  pull_ = pull_forwards(mesh_, mesh_.reference, found_.plates.paddle, options_.pull_N);
  if (!load_with(pull_, "pull")) return false;
  note_stage("pulled");
  return true;
}

void PlacedCompression::say_where_plates_stand() const {
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

void PlacedCompression::run() {
  state_ = scene_.at_rest(flatten(mesh_.reference));
  if (position()) {
    set_target();
    say_where_plates_stand();
    close_plates();
  }
  count_factorisations();
}

void PlacedCompression::finish(int iterations_left) {
  found_.left_with_on_edge.reset();
  conclude_path([&] { return way_->finish(state_, iterations_left); });
  count_factorisations();
}

}  // namespace breast
