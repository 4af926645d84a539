// SPDX-License-Identifier: GPL-3.0-or-later
// The plates' normal forces on skin nodes as a term: given multipliers, or a penalty about them.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "solve/term.hpp"

namespace breast {

/// A node that may touch a plate.
struct PlateEntry {
  int node = 0;
  int plate = -1;         ///< 0 paddle, 1 detector; −1: whichever is nearer
  double multiplier = 0;  ///< µN per unit gap gradient
};

/// Where an entry stands, and the force f along the gap's gradient, µN.
struct PlateForce {
  int plate = 0;
  Gap gap;
  double force = 0;
};

/// With a penalty ρ the energy is Σ (f² − λ²)/2ρ, f = max(0, λ − ρ g): the augmented Lagrangian.
/// Without (ρ = 0) it is −Σ λ g: the multiplier itself, whose gap is held by a constraint; only the
/// turning of its direction (−λ ∇²g) then enters the tangent.
class PlateTerm final : public Term {
 public:
  explicit PlateTerm(std::vector<int> candidates);

  /// Where the plates stand from now on.
  void set_plates(const PlatePair& plates) { plates_ = plates; }
  void set_penalty(double penalty) { penalty_ = penalty; }
  PlateEntry& entry(std::size_t candidate) { return entries_[candidate]; }
  const PlateEntry& entry(std::size_t candidate) const { return entries_[candidate]; }
  PlateForce at(std::size_t candidate, const Eigen::VectorXd& x) const;

  std::string name() const override { return "plates"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override;

 private:
  PlatePair plates_;
  double penalty_ = 0;  // µN/mm
  std::vector<PlateEntry> entries_;
  Cells cells_;  // one node each
};

}  // namespace breast
