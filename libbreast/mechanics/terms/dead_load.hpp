// SPDX-License-Identifier: GPL-3.0-or-later
// Constant nodal forces as a term: gravity, computed once on the imaged shape.
#pragma once

#include "solve/term.hpp"

namespace breast {

class DeadLoad final : public Term {
 public:
  /// µN, 3 per node.
  explicit DeadLoad(Eigen::VectorXd force) : force_(std::move(force)) {}
  void set(Eigen::VectorXd force) { force_ = std::move(force); }
  const Eigen::VectorXd& force() const { return force_; }
  /// Sum over nodes, µN.
  Vec3 total() const;

  std::string name() const override { return "dead load"; }
  /// Energy −f·(x − X). The forces do not depend on X.
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override;

 private:
  Eigen::VectorXd force_;
};

}  // namespace breast
