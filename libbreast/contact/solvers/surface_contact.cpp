// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/surface_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "contact/faces.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {
/// Factor on the stiffness of plates that are penetrated too deeply, the smallest value to which it
/// is reduced after failed solves, and the largest number of solves.
constexpr double stiffer = 4, least_stiffer = 1.4;
constexpr int most_stiffenings = 24;
/// Residual of the intermediate states.
constexpr double between_tolerance = 1e-3;
/// Below this residual the tangent includes the rotation of all forces; above it, only of points up
/// to the allowed depth times this factor.
constexpr double near_residual = 0.3, turning_depth = 1.2;
/// Number of times that points are chosen anew for an accurate solution.
constexpr int most_choices = 4;
/// Relative difference that may remain between the friction bounds and the normal forces. On the way it
/// is not larger, because bounds from the previous position would make the result depend on the steps. Where
/// a force is sought, 1 % of the friction matters little: the solution at the same position, whose bounds
/// are closer, then met the force to 0.7 instead of 0.5 % on one of 28 views of women.
constexpr double bounds_tolerance = 1e-3, sought_bounds_tolerance = 0.01,
                 way_bounds_tolerance = 0.05;
/// The bounds are changed at most this often in one solve.
constexpr int most_bounds = 12;
/// If more than this fraction of the lag remains after the bounds have followed, they alternate: from
/// then on they follow by half as much.
constexpr double lag_kept = 0.7;
/// After this number of iterations whose residual is not below this fraction of the best, steps go to
/// the minimum of the energy.
constexpr int patience = 2;
constexpr double improvement = 0.9;
/// Number of iterations that leave out the rotation of the forces after one whose tangent was indefinite
/// with it.
constexpr int without_rotation = 1;
/// The contact area changes by a 64th of a face at a time, 0.1 to 0.3 % of the area.
constexpr double relative_resolution = 5e-3;
}  // namespace

/// An equilibrium with the present stiffness of the plates.
class SurfaceContact::System final : public TangentSystem {
 public:
  System(SurfaceContact& owner, State& state, double tolerance, double depth)
      : TangentSystem(owner.problem_, owner.solver_, owner.matrix_, state),
        owner_(owner),
        tolerance_(tolerance),
        depth_(depth) {}

  bool begin() { return look(); }
  bool hurried() const { return hurried_; }
  double friction_lag() const { return lag_; }
  /// Number of iterations before the friction bounds changed; −1: they did not.
  int before_follow() const { return before_follow_; }

  Balance assess(const NewtonResult& so_far) override;
  NewtonDirection direction(const Balance& now) override;
  LineSearchRule rule(const NewtonResult&, const Balance& now,
                      const NewtonDirection& direction) const override;

 private:
  Appraisal appraise(const State& state, const Forces& forces) const override;
  bool begins_badly(const NewtonResult& so_far, double residual) const;
  double residual() const { return relative(forces_, problem_.constraints_at(state_.x)); }
  bool follow_bounds(double residual);
  void count_stagnation(double residual);
  /// Unbalanced force relative to the force of the plates.
  double relative(const Forces& forces, const Constraints& held) const {
    return problem_.free_norm(held, forces) / scale_;
  }

  SurfaceContact& owner_;
  double tolerance_, depth_, first_ = 0, scale_ = 1, lag_ = 0;
  int followed_ = 0, before_follow_ = -1;
  double followed_lag_ = std::numeric_limits<double>::infinity();  // when they last followed
  double following_part_ = 1;  // of the way to the bounds that the normal forces allow
  bool hurried_ = false;
  double best_ = std::numeric_limits<double>::infinity();  // residual with the present bounds
  int without_gain_ = 0;                                   // iterations since
  bool simplified_ = false;  // whether the tangent lacks the rotation of the forces
  int simplifications_ = 0;
  int skipped_ = 0;  // further iterations that leave it out untried
};

Balance SurfaceContact::System::assess(const NewtonResult& so_far) {
  const SurfacePressure& plates = *owner_.pressure_;
  scale_ = std::max({plates.plate_forces(state_.x, 0).norm(),
                     plates.plate_forces(state_.x, 1).norm(), problem_.load_norm(), 1e-30});
  Balance now;
  now.residual = residual();
  if (follow_bounds(now.residual)) {
    now.residual = residual();
    if (before_follow_ < 0) before_follow_ = int(so_far.iterations.size());
    best_ = std::numeric_limits<double>::infinity();
  }
  now.merit = now.residual;
  count_stagnation(now.residual);
  const SurfaceContactOptions& options = owner_.options_;
  now.converged = now.residual <= tolerance_ && problem_.volume_residual(forces_) <=
                                                    std::max(tolerance_, options.volume_tolerance);
  if (now.converged) return now;
  const int made = int(so_far.iterations.size());
  if (made == 1) first_ = now.residual;
  hurried_ = owner_.fail_fast_ && begins_badly(so_far, now.residual);
  const int slipping = so_far.indefinite + simplifications_;
  const int allowed =
      std::min(options.max_iterations + slip_allowance * slipping, options.most_iterations);
  if (made >= allowed || hurried_) {
    now.stop = NewtonStop::iteration_limit;
    now.reason = describe(now.stop);
  }
  return now;
}

/// Full steps over the kinks of the plates' and the friction's forces may repeat.
void SurfaceContact::System::count_stagnation(double residual) {
  if (residual < improvement * best_) {
    best_ = residual;
    without_gain_ = 0;
  } else {
    ++without_gain_;
  }
}

/// If the state is balanced well enough for its normal forces to be meaningful, the friction bounds
/// follow them. Where a point comes and goes with its friction, the bounds alternate unless they
/// follow only part of the way.
bool SurfaceContact::System::follow_bounds(double residual) {
  if (owner_.friction_ == nullptr || residual > std::max(tolerance_, balance_to_follow))
    return false;
  Bounds bounds = owner_.bounds_at(state_.x);
  lag_ = bounds.lag;
  const bool on_the_way = tolerance_ > owner_.options_.way_tolerance;
  const bool sought = tolerance_ > owner_.options_.accurate_tolerance;
  const bool close = lag_ <= (on_the_way ? way_bounds_tolerance
                              : sought   ? sought_bounds_tolerance
                                         : bounds_tolerance);
  if (close || residual > std::max(tolerance_, balance_to_follow * lag_)) return false;
  if (++followed_ > most_bounds) return false;
  if (lag_ > lag_kept * followed_lag_) following_part_ *= 0.5;
  followed_lag_ = lag_;
  bounds.approach_from(owner_.memory_.bounds, following_part_);
  // A node deep in the rounded edge may turn its normal back and forth, and the bounds with it.
  // An accurate solution has the directions at its own positions.
  const bool alternates = following_part_ < 1 && on_the_way;
  change({owner_.friction_.get()}, [&] { owner_.adopt(std::move(bounds), state_, alternates); });
  return true;
}

/// Positions too far from the last one are recognised in the first iterations.
bool SurfaceContact::System::begins_badly(const NewtonResult& so_far, double residual) const {
  constexpr BadBeginning bad{.first_step = 0.1, .remainder = 0.7, .iterations = 12};
  return bad.seen_in(so_far, residual, first_);
}

// Where a face rolls over an edge, the rotation of the plates' forces may make the tangent
// indefinite. Without this rotation the tangent leads downhill just as well, and no shift is
// needed. What an iteration finds is likely in the next as well, which is spared the trial.
NewtonDirection SurfaceContact::System::direction(const Balance& now) {
  const NewtonDirection none{NewtonStop::indefinite, describe(NewtonStop::indefinite)};
  const double depth = now.residual < near_residual ? std::numeric_limits<double>::infinity()
                                                    : turning_depth * depth_;
  const Constraints held = problem_.constraints_at(state_.x);
  simplified_ = skipped_ > 0;
  if (simplified_) {
    --skipped_;
  } else {
    owner_.pressure_->set_turning_depth(depth);
    if (!assemble()) return {NewtonStop::folded, describe(NewtonStop::folded)};
    simplified_ = !factorise(held, false).ok;
    if (simplified_) skipped_ = without_rotation;
  }
  if (simplified_) {
    ++simplifications_;
    owner_.pressure_->set_turning_depth(0);
    if (!assemble() || !factorise(held).ok) return none;
  }
  NewtonDirection direction = solve(contact_volume_accuracy, gmres_restarts);
  if (!step_.u.allFinite() || !step_.p.allFinite()) return none;
  return direction;
}

LineSearchRule SurfaceContact::System::rule(const NewtonResult&, const Balance& now,
                                            const NewtonDirection& direction) const {
  LineSearchRule rule;
  rule.merit = now.merit;
  rule.tolerance = tolerance_;
  rule.flat_suffices = true;
  rule.downhill_suffices = direction.shift > 0 || simplified_;
  rule.kinks = true;
  rule.to_minimum = without_gain_ >= patience && !rule.downhill_suffices;
  return rule;
}

Appraisal SurfaceContact::System::appraise(const State& state, const Forces& forces) const {
  Eigen::VectorXd gradient = forces.augmented.size() > 0 ? forces.augmented : forces.r;
  const Constraints held = problem_.constraints_at(state.x);
  held.project(gradient);
  const double there = relative(forces, held);
  return {there, there, along(gradient)};
}

SurfaceContact::SurfaceContact(const HexMesh& mesh, const std::vector<Face>& faces,
                               const Problem& body, SaddleSolver& solver,
                               SurfaceContactOptions options)
    : problem_(body),
      solver_(solver),
      matrix_(body.make_matrix()),
      options_(options),
      pressure_(std::make_shared<SurfacePressure>(mesh, faces, body.space())),
      candidates_(pressure_->nodes()) {
  memory_.touching.assign(candidates_.size(), -1);
  memory_.penalty = options.stiffness;
  problem_.add(pressure_);
  if (!options.friction.present()) return;
  memory_.bounds.assign(candidates_.size(), 0);
  friction_ = std::make_shared<FrictionTerm>();
  problem_.add(friction_);
}

std::vector<Face> SurfaceContact::contact_faces(const HexTopology& mesh) const {
  return touchable_faces(mesh);
}

double SurfaceContact::resolution() const {
  return relative_resolution;
}

void SurfaceContact::fill_record(const State& solution, ContactRecord& record) const {
  record.surface_stiffness = pressure_->stiffness();
  record.face_rules = pressure_->face_rules();
  if (friction_ == nullptr) return;
  for (const FrictionEntry& held : friction_->entries()) {
    record.friction.push_back({held.node, held.plate, friction_->anchor_in_plane(held, solution.x),
                               held.bound, held.stick});
  }
}

bool SurfaceContact::equilibrate(State& state, double tolerance, double depth, ContactStep& step) {
  pressure_->set_stiffness(memory_.penalty);
  set_friction(state.x);
  System system(*this, state, tolerance, depth);
  if (!system.begin()) {
    step.stop = system.refusal();
    step.failed_trial = state.x;
    return false;
  }
  const NewtonResult part = newton(system);
  step.append(part);
  step.forces = system.forces();
  step.hurried = system.hurried();
  step.friction_lag = system.friction_lag();
  if (system.before_follow() >= 0) {
    step.corrections += int(part.iterations.size()) - system.before_follow();
  }
  if (!part.converged && step.failed_trial.size() == 0) step.failed_trial = system.refused();
  return part.converged;
}

/// An equilibrium with the plates as stiff as they were at their last position. Where there is none
/// within reach, because the faces of the first guess lie too deep in them: with plates that press on
/// the deepest point as much as before, and after that with the softest.
bool SurfaceContact::begin(State& state, double tolerance, double allowed, ContactStep& step) {
  const State given = state;
  const ContactMemory memory = memory_;
  const double guessed = pressure_->deepest(state.x);
  std::vector<double> penalties{memory.penalty};
  const double softer = memory.penalty * memory.deepest / std::max(guessed, memory.deepest);
  for (const double next : {softer, options_.stiffness})
    if (next >= options_.stiffness && next < penalties.back()) penalties.push_back(next);
  for (const double penalty : penalties) {
    memory_ = memory;
    memory_.penalty = penalty;
    state = given;
    if (equilibrate(state, tolerance, allowed, step)) return true;
    if (fail_fast_) return false;
  }
  return false;
}

/// Increases the stiffness until no point lies too deep. Each solve begins at a state extrapolated from the
/// last two; where that finds no equilibrium, at the last state itself, and after that the factor of the
/// increase becomes smaller.
bool SurfaceContact::stiffen(State& state, double allowed, ContactStep& step) {
  const std::size_t before = step.iterations.size();
  double factor = stiffer;
  std::optional<State> before_softer;  // at the stiffness below that of `softer`
  for (int k = 0; k < most_stiffenings && pressure_->deepest(state.x) > allowed; ++k) {
    const State softer = state;
    const ContactMemory memory = memory_;
    if (!step.softer) step.softer = softer;
    memory_.penalty *= factor;
    // The depth is inverse to the stiffness, and so is what remains of the way to rigid plates.
    const bool guessed = before_softer.has_value();
    if (guessed) {
      state.x += (softer.x - before_softer->x) / factor;
      state.p += (softer.p - before_softer->p) / factor;
    }
    if (equilibrate(state, between_tolerance, allowed, step)) {
      before_softer = softer;
      continue;
    }
    before_softer.reset();
    state = softer;
    memory_ = memory;
    if (guessed) continue;  // from the softer state itself
    factor = std::sqrt(factor);
    if (fail_fast_ || factor < least_stiffer) return false;
  }
  step.corrections += int(step.iterations.size() - before);
  return true;
}

// An accurate state uses at least the points that it would choose itself.
ContactStep SurfaceContact::solve(const PlatePair& plates, State& state, double tolerance) {
  pressure_->set_plates(plates);
  if (friction_ != nullptr && memory_.anchors.empty()) {
    for (const int node : candidates_) memory_.anchors.push_back(state.x.segment<3>(3L * node));
    memory_.plates = plates;
  }
  ContactStep step;
  pressure_->choose_points(state.x);
  const bool on_the_way = tolerance > options_.way_tolerance;
  const double allowed = on_the_way ? options_.way_depth : options_.depth;
  if (!begin(state, std::max(tolerance, between_tolerance), allowed, step)) return step;
  if (!stiffen(state, allowed, step)) return step;
  for (int k = 0; k < most_choices; ++k) {
    if (!equilibrate(state, tolerance, allowed, step)) return step;
    if (on_the_way || !pressure_->choose_points(state.x, true)) break;
  }
  memory_.deepest = pressure_->deepest(state.x);
  finish(state, step);
  return step;
}

/// The nodes that the plates held in the last solve, with the normal forces of that solve and the
/// plates' normals at `x`; `keep_normals`: nodes that are held already keep theirs.
void SurfaceContact::set_friction(const Eigen::VectorXd& x, bool keep_normals) {
  if (friction_ == nullptr) return;
  std::map<std::pair<int, int>, Vec3> kept;  // by node and plate
  for (const FrictionEntry& entry : friction_->entries()) {
    if (keep_normals && entry.normal)
      kept.emplace(std::pair(entry.node, entry.plate), *entry.normal);
  }
  std::vector<FrictionEntry> held;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const int k = memory_.touching[c];
    if (k < 0 || !(memory_.bounds[c] > 0)) continue;
    const Plate& plate = pressure_->plates().plate(k);
    const auto before = kept.find({candidates_[c], k});
    held.push_back({candidates_[c], k, memory_.anchors[c] + plate.shift(), memory_.bounds[c],
                    options_.friction.stick(memory_.bounds[c]),
                    before != kept.end() ? before->second
                                         : plate.gap(x.segment<3>(3L * candidates_[c])).gradient});
  }
  friction_->set_plates(pressure_->plates());
  friction_->set_entries(std::move(held));
}

/// The bounds that the normal forces of these positions allow, and how far the present ones lag.
SurfaceContact::Bounds SurfaceContact::bounds_at(const Eigen::VectorXd& x) const {
  Bounds bounds{nodal_contacts(x), std::vector<double>(candidates_.size(), 0)};
  double lag = 0, size = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const NodalContact& contact = bounds.contacts[c];
    if (contact.plate >= 0) bounds.values[c] = options_.friction.bound(contact.normal);
    lag = std::hypot(lag, bounds.values[c] - memory_.bounds[c]);
    size = std::hypot(size, bounds.values[c]);
  }
  bounds.lag = size > 0 ? lag / size : 0;
  return bounds;
}

void SurfaceContact::adopt(Bounds bounds, const State& state, bool keep_normals) {
  for (std::size_t c = 0; c < candidates_.size(); ++c) hold(c, bounds.contacts[c].plate, state);
  memory_.bounds = std::move(bounds.values);
  set_friction(state.x, keep_normals);
}

/// Anchors a node that has come into contact with a plate since the last solution at the place on
/// the plate that it touched first. Without this, friction would begin only with the next position
/// of the plates, and the result would depend on the steps.
void SurfaceContact::hold(std::size_t c, int plate, const State& state) {
  if (plate < 0 || memory_.touching[c] == plate) return;
  const Plate& before = memory_.plates.plate(plate);
  const Plate& now = pressure_->plates().plate(plate);
  const Vec3 from = memory_.anchors[c], to = state.x.segment<3>(3L * candidates_[c]);
  const double gap = std::max(0.0, before.gap(from).value);
  const double closed = gap - now.gap(from).value;
  const double part = closed > gap ? gap / closed : 1;
  memory_.anchors[c] = (1 - part) * (from - before.shift()) + part * (to - now.shift());
  memory_.touching[c] = static_cast<signed char>(plate);
}

/// Anchors follow their sliding nodes; free nodes are anchored at their position.
void SurfaceContact::move_anchors(const State& state, ContactStep& step) {
  std::size_t entry = 0;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const Vec3 place = state.x.segment<3>(3L * candidates_[c]);
    Vec3 force = Vec3::Zero(), anchor = place;
    if (entry < friction_->entries().size() && friction_->entries()[entry].node == candidates_[c]) {
      const FrictionEntry& held = friction_->entries()[entry++];
      force = friction_->at(held, state.x).force;
      anchor = friction_->next_anchor(held, state.x);
    }
    const int k = step.contacts[c].plate;
    memory_.bounds[c] = 0;
    if (k < 0) {
      memory_.anchors[c] = place;
      continue;
    }
    step.contacts[c].tangential += force;
    step.pressed.push_back({k, place, force});
    memory_.bounds[c] = options_.friction.bound(step.contacts[c].normal);
    if (memory_.touching[c] != k) {
      hold(c, k, state);
    } else {
      memory_.anchors[c] = anchor - pressure_->plates().plate(k).shift();
    }
  }
  memory_.plates = pressure_->plates();
}

std::vector<NodalContact> SurfaceContact::nodal_contacts(const Eigen::VectorXd& x) const {
  std::vector<NodalContact> contacts(candidates_.size());
  for (int k = 0; k < 2; ++k) {
    const Eigen::VectorXd force = pressure_->plate_forces(x, k);
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const Vec3 own = force.segment<3>(3L * candidates_[c]);
      if (own.isZero(0)) continue;
      const Vec3 normal =
          pressure_->plates().plate(k).gap(x.segment<3>(3L * candidates_[c])).gradient;
      contacts[c] = {k, own.dot(normal), own - own.dot(normal) * normal};
    }
  }
  return contacts;
}

void SurfaceContact::finish(const State& state, ContactStep& step) {
  step.converged = true;
  step.failed_trial.resize(0);
  step.pressed = pressure_->pressed(state.x);
  step.worst_penetration = pressure_->deepest(state.x);
  step.contacts = nodal_contacts(state.x);
  if (friction_ != nullptr) move_anchors(state, step);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    memory_.touching[c] = static_cast<signed char>(step.contacts[c].plate);
  }
}

}  // namespace breast
