// SPDX-License-Identifier: GPL-3.0-or-later
// The Newton system of the active-set method at one plate position; the set of touching nodes
// changes between iterations.
#pragma once

#include <functional>
#include <vector>

#include "contact/solvers/active_set.hpp"
#include "solve/equilibrate.hpp"

namespace breast {

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

}  // namespace breast
