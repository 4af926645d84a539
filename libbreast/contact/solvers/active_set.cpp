// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/solvers/raise_friction.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

namespace {

Vec3 node_vector(const Eigen::VectorXd& field, int node) {
  return field.segment<3>(3L * node);
}
/// A node that changed its status this often within one step stays in contact until convergence.
constexpr int most_toggles = 3;
/// Number of iterations in which touching nodes may move freely onto the plate.
constexpr int free_moves = 8;
/// A node is released if it is pulled with more than this, relative to the scale times the
/// tolerance.
constexpr double least_pull = 0.1;
/// A step that is much too long is detected early: after hopeless_iterations the imbalance is
/// hopeless_growth times the first one and more than hopeless_imbalance times the forces.
constexpr int hopeless_iterations = 6;
constexpr double hopeless_growth = 4, hopeless_imbalance = 0.1;

}  // namespace

/// The Newton system at one plate position; the set of touching nodes changes between iterations.
class ActiveSet::System final : public TangentSystem {
 public:
  System(ActiveSet& owner, State& state, double tolerance);

  /// False if the initial state is inadmissible.
  bool begin() { return look(); }
  Balance assess(const NewtonResult& so_far) override;
  NewtonDirection direction(const Balance& now) override;
  LineSearchRule rule(const NewtonResult& so_far, const Balance& now,
                      const NewtonDirection& direction) const override;
  /// After convergence: returns the forces per candidate and moves the anchors with their nodes.
  std::vector<NodalContact> finish();
  bool hurried() const { return hurried_; }

 private:
  struct Sweep;
  Appraisal appraise(const State& state, const Forces& forces) const override;
  bool rubs() const { return owner_.options_.friction.present(); }
  double pressed(std::size_t candidate, const State& state, const Forces& forces) const;
  Sweep measure(const State& state, const Forces& forces) const;
  bool balanced(const Sweep& sweep) const;
  void change(const std::function<void()>& what);
  bool follow_bounds(const Sweep& now);
  bool touch(std::size_t candidate);
  bool let_go(std::size_t candidate, double least_pull);
  bool update(double scale, bool may_drop, bool at_balance);
  bool hopeless(const NewtonResult& so_far, const Sweep& now) const;
  bool begins_badly(const NewtonResult& so_far, const Sweep& now) const;
  Balance verdict(const NewtonResult& so_far, const Sweep& now, bool done);

  ActiveSet& owner_;
  double tolerance_;
  std::vector<int> toggles_;
  double first_imbalance_ = 0, worst_gap_ = 0;
  bool hurried_ = false;
};

/// Residual and constraint violation of a state with the present touching set.
struct ActiveSet::System::Sweep {
  double free_norm = 0,
         scale = 0;  ///< unbalanced force, and the reaction or load with which it is compared, µN
  double worst_gap = 0;  ///< largest |distance| of touching nodes, mm
  double volume_residual = 0;
  Eigen::VectorXd
      gradient;  ///< gradient of the augmented energy, without reactions and touching normals
  double relative() const { return free_norm / scale; }
  double merit() const { return relative() + worst_gap; }
};

ActiveSet::System::System(ActiveSet& owner, State& state, double tolerance)
    : TangentSystem(owner.problem_, owner.solver_, owner.matrix_, state),
      owner_(owner),
      tolerance_(tolerance),
      toggles_(owner.candidates_.size(), 0) {}

/// Force of the plate along its normal, µN, which balances all other forces there.
double ActiveSet::System::pressed(std::size_t c, const State& state, const Forces& forces) const {
  const int node = owner_.candidates_[c];
  const Gap gap = owner_.plates_.plate(owner_.memory_.touching[c]).gap(node_vector(state.x, node));
  return owner_.plate_->entry(c).multiplier + node_vector(forces.r, node).dot(gap.gradient);
}

ActiveSet::System::Sweep ActiveSet::System::measure(const State& state,
                                                    const Forces& forces) const {
  Sweep sweep;
  Eigen::VectorXd free = forces.r;
  sweep.gradient = forces.augmented.size() > 0 ? forces.augmented : forces.r;
  const Constraints held = problem_.constraints_at(state.x);
  held.project(free);
  held.project(sweep.gradient);
  double reaction = 0;
  for (std::size_t c = 0; c < owner_.candidates_.size(); ++c) {
    if (owner_.memory_.touching[c] < 0) continue;
    const int node = owner_.candidates_[c];
    const Eigen::Index at = 3L * node;
    const Gap gap =
        owner_.plates_.plate(owner_.memory_.touching[c]).gap(node_vector(state.x, node));
    const double force = pressed(c, state, forces);
    reaction += force * force;
    free.segment<3>(at) -= free.segment<3>(at).dot(gap.gradient) * gap.gradient;
    sweep.gradient.segment<3>(at) -= sweep.gradient.segment<3>(at).dot(gap.gradient) * gap.gradient;
    sweep.worst_gap = std::max(sweep.worst_gap, std::abs(gap.value));
  }
  sweep.free_norm = free.norm();
  sweep.scale = std::max({std::sqrt(reaction), problem_.load_norm(), 1e-30});
  sweep.volume_residual = problem_.volume_residual(forces);
  return sweep;
}

bool ActiveSet::System::balanced(const Sweep& sweep) const {
  return sweep.relative() <= tolerance_ &&
         sweep.worst_gap <= std::max(owner_.options_.gap_tolerance, tolerance_) &&
         sweep.volume_residual <= std::max(owner_.options_.volume_tolerance, tolerance_);
}

/// Changes the memory and updates the terms and the present forces.
void ActiveSet::System::change(const std::function<void()>& what) {
  std::vector<const Term*> terms = {owner_.plate_.get()};
  if (owner_.friction_ != nullptr) terms.push_back(owner_.friction_.get());
  TangentSystem::change(terms, [&] {
    what();
    owner_.set_terms(PlatePair(owner_.plates_));
  });
}

/// If the state is balanced well enough for its normal forces to be meaningful, uses μλ as the
/// bounds. The bounds do not follow in every iteration, because both could then oscillate for ever.
bool ActiveSet::System::follow_bounds(const Sweep& now) {
  std::vector<double> wanted(owner_.candidates_.size(), 0);
  double lag = 0;
  for (std::size_t c = 0; c < wanted.size(); ++c) {
    if (owner_.memory_.touching[c] < 0) continue;
    wanted[c] = owner_.options_.friction.bound(pressed(c, state_, forces_));
    lag = std::hypot(lag, wanted[c] - owner_.memory_.bounds[c]);
  }
  if (now.relative() > std::max(tolerance_, balance_to_follow * lag / now.scale)) return false;
  change([&] { owner_.memory_.bounds = std::move(wanted); });
  return true;
}

/// The anchor of the node moves with the plate from now on.
bool ActiveSet::System::touch(std::size_t c) {
  const Vec3 x = node_vector(state_.x, owner_.candidates_[c]);
  const int k = owner_.plates_.nearer(x);
  if (!(owner_.plates_.plate(k).gap(x).value < -owner_.options_.gap_tolerance)) return false;
  owner_.memory_.touching[c] = static_cast<signed char>(k);
  owner_.memory_.multipliers[c] = 0;
  if (rubs()) owner_.memory_.anchors[c] -= owner_.plates_.plate(k).shift();
  ++toggles_[c];
  return true;
}

bool ActiveSet::System::let_go(std::size_t c, double pull) {
  if (!(pressed(c, state_, forces_) < -pull)) return false;
  if (rubs()) {
    owner_.memory_.anchors[c] += owner_.plates_.plate(owner_.memory_.touching[c]).shift();
  }
  owner_.memory_.touching[c] = -1;
  return true;
}

bool ActiveSet::System::update(double scale, bool may_drop, bool at_balance) {
  bool changed = false;
  change([&] {
    for (std::size_t c = 0; c < owner_.candidates_.size(); ++c) {
      if (owner_.memory_.touching[c] < 0) {
        changed = touch(c) || changed;
      } else if (may_drop && (at_balance || toggles_[c] < most_toggles)) {
        changed = let_go(c, least_pull * tolerance_ * scale) || changed;
      }
    }
  });
  return changed;
}

bool ActiveSet::System::hopeless(const NewtonResult& so_far, const Sweep& now) const {
  return so_far.indefinite == 0 && int(so_far.iterations.size()) >= hopeless_iterations &&
         now.relative() > hopeless_growth * first_imbalance_ && now.relative() > hopeless_imbalance;
}

/// Positions too far from the last one are recognised in the first iterations.
bool ActiveSet::System::begins_badly(const NewtonResult& so_far, const Sweep& now) const {
  constexpr BadBeginning bad{.first_step = 0.2, .remainder = 0.5, .iterations = 8};
  return bad.seen_in(so_far, now.relative(), first_imbalance_);
}

Balance ActiveSet::System::verdict(const NewtonResult& so_far, const Sweep& now, bool done) {
  const ActiveSetOptions& options = owner_.options_;
  const int made = int(so_far.iterations.size());
  Balance balance;
  balance.residual = now.relative();
  balance.merit = now.merit();
  if (done) {
    balance.converged = true;
    return balance;
  }
  if (made == 1) first_imbalance_ = now.relative();
  hurried_ = owner_.fail_fast_ && begins_badly(so_far, now);
  // A snap-through ends far from its start: its iterations do not count towards the limit.
  const int allowed = std::min(options.max_iterations + slip_allowance * so_far.indefinite,
                               options.most_iterations);
  if (made >= allowed || hopeless(so_far, now) || hurried_) {
    balance.stop = NewtonStop::iteration_limit;
    balance.reason = describe(balance.stop);
  }
  return balance;
}

Balance ActiveSet::System::assess(const NewtonResult& so_far) {
  Sweep now = measure(state_, forces_);
  if (rubs() && follow_bounds(now)) now = measure(state_, forces_);
  const bool at_balance = balanced(now);
  // The multipliers of a state far from balance are noise: pulling nodes are dropped after the
  // first linearised solve, and later only from a converged state.
  const int made = int(so_far.iterations.size());
  const bool may_drop = at_balance || (made > 0 && made < owner_.options_.free_sweeps);
  const bool changed = update(now.scale, may_drop, at_balance);
  if (changed) now = measure(state_, forces_);
  worst_gap_ = now.worst_gap;
  return verdict(so_far, now, at_balance && !changed);
}

// When a node slides on a rounded edge, the direction of its plate force rotates. Without this
// rotation in the tangent, Newton's method loses its quadratic convergence and the plate steps
// collapse.
NewtonDirection ActiveSet::System::direction(const Balance&) {
  change([&] {
    for (std::size_t c = 0; c < owner_.candidates_.size(); ++c) {
      const bool held = owner_.memory_.touching[c] >= 0;
      owner_.memory_.multipliers[c] = held ? std::max(0.0, pressed(c, state_, forces_)) : 0;
    }
  });
  if (!assemble()) return {NewtonStop::folded, describe(NewtonStop::folded)};
  const Factorisation factor = factorise(owner_.constraints(state_));
  if (!factor.ok) return {NewtonStop::indefinite, describe(NewtonStop::indefinite)};
  NewtonDirection direction = solve(contact_volume_accuracy, gmres_restarts);
  if (!step_.u.allFinite() || !step_.p.allFinite()) {
    return {NewtonStop::indefinite, describe(NewtonStop::indefinite)};
  }
  return direction;
}

LineSearchRule ActiveSet::System::rule(const NewtonResult& so_far, const Balance& now,
                                       const NewtonDirection& direction) const {
  const bool early = int(so_far.iterations.size()) < free_moves;
  // While nodes are brought onto the plate the balance necessarily becomes worse, so any admissible
  // step is taken. Where the edge becomes straight this can alternate for ever; later iterations
  // must therefore reduce imbalance and gap together. A slipping node offers no resistance until it
  // turns back, where friction has the opposite sign: with friction, no step goes beyond the point
  // where the slope has changed by that much.
  LineSearchRule rule;
  rule.merit = now.merit;
  rule.tolerance = tolerance_;
  rule.any = !rubs() && worst_gap_ > 1e-3 && early;
  rule.flat_suffices = rubs() || early;
  rule.downhill_suffices = direction.shift > 0;
  return rule;
}

Appraisal ActiveSet::System::appraise(const State& state, const Forces& forces) const {
  const Sweep sweep = measure(state, forces);
  return {sweep.relative(), sweep.merit(), along(sweep.gradient)};
}

// Anchors follow their sliding nodes; the component normal to the plate is irrelevant.
std::vector<NodalContact> ActiveSet::System::finish() {
  std::vector<NodalContact> contacts(owner_.candidates_.size());
  std::size_t entry = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int k = owner_.memory_.touching[c];
    if (k < 0) {
      if (rubs()) owner_.memory_.anchors[c] = node_vector(state_.x, owner_.candidates_[c]);
      continue;
    }
    contacts[c].plate = k;
    contacts[c].normal = pressed(c, state_, forces_);
    if (!rubs()) continue;
    const FrictionEntry& held = owner_.friction_->entries()[entry++];
    contacts[c].tangential = owner_.friction_->at(held, state_.x).force;
    owner_.memory_.anchors[c] =
        owner_.friction_->next_anchor(held, state_.x) - owner_.plates_.plate(k).shift();
  }
  return contacts;
}

ActiveSet::ActiveSet(const Problem& body, SaddleSolver& solver, std::vector<int> candidates,
                     ActiveSetOptions options)
    : problem_(body),
      solver_(solver),
      matrix_(body.make_matrix()),
      candidates_(std::move(candidates)),
      options_(options),
      plate_(std::make_shared<PlateTerm>(candidates_)) {
  memory_.touching.assign(candidates_.size(), -1);
  memory_.multipliers.assign(candidates_.size(), 0);
  problem_.add(plate_);
  if (!options.friction.present()) return;
  friction_ = std::make_shared<FrictionTerm>();
  problem_.add(friction_);
}

// Touching nodes keep their anchor relative to the level of the plate; free nodes are anchored at
// their position.
void ActiveSet::set_terms(const PlatePair& plates) {
  plates_ = plates;
  plate_->set_plates(plates);
  std::vector<FrictionEntry> held;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const int k = memory_.touching[c];
    plate_->entry(c).plate = k;
    plate_->entry(c).multiplier = k < 0 ? 0 : memory_.multipliers[c];
    if (friction_ == nullptr || k < 0) continue;
    held.push_back({candidates_[c], k, memory_.anchors[c] + plates.plate(k).shift(),
                    memory_.bounds[c], options_.friction.stick(memory_.bounds[c])});
  }
  if (friction_ == nullptr) return;
  friction_->set_plates(plates);
  friction_->set_entries(std::move(held));
}

Constraints ActiveSet::constraints(const State& state) const {
  Constraints all = problem_.constraints_at(state.x);
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (memory_.touching[c] < 0) continue;
    const int node = candidates_[c];
    const Gap gap = plates_.plate(memory_.touching[c]).gap(state.x.segment<3>(3L * node));
    all.hold_along(node, gap.gradient, -gap.value);
  }
  return all;
}

std::optional<ContactEstimate> ActiveSet::for_estimate(const HexMesh& mesh, const PlatePair& plates,
                                                       const State& solution) const {
  std::optional<ContactEstimate> estimate = ContactSolver::for_estimate(mesh, plates, solution);
  if (friction_ != nullptr) {
    estimate->plates = friction_;
    estimate->raise_plates = [friction = friction_, &mesh, &solution](const RicherMesh& richer) {
      return raise_friction(*friction, mesh, solution.x, richer);
    };
  }
  return estimate;
}

ContactStep ActiveSet::solve(const PlatePair& plates, State& state, double tolerance) {
  if (friction_ != nullptr && memory_.anchors.empty()) {
    for (const int node : candidates_) memory_.anchors.push_back(state.x.segment<3>(3L * node));
    memory_.bounds.assign(candidates_.size(), 0);
  }
  set_terms(plates);
  ContactStep step;
  System system(*this, state, tolerance);
  if (!system.begin()) {
    step.stop = system.refusal();
    step.failed_trial = state.x;
    return step;
  }
  static_cast<NewtonResult&>(step) = newton(system);
  step.hurried = system.hurried();
  if (step.converged) {
    step.contacts = system.finish();
    step.pressed = pressed_nodes(plates, state, step.contacts);
  } else {
    step.failed_trial = system.refused();
  }
  step.forces = system.forces();
  for (const int node : candidates_) {
    const Vec3 x = state.x.segment<3>(3L * node);
    const double distance = plates.plate(plates.nearer(x)).gap(x).value;
    step.worst_penetration = std::max(step.worst_penetration, -distance);
  }
  return step;
}

}  // namespace breast
