// SPDX-License-Identifier: GPL-3.0-or-later
// The plates' normal forces on skin nodes as a term: given multipliers, with or without a penalty.
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

/// Gap of an entry, and its force f along the gradient of the gap, µN.
struct PlateForce {
  int plate = 0;
  Gap gap;
  double force = 0;
};

/// With a penalty ρ the energy is Σ (f² − λ²)/2ρ, f = max(0, λ − ρ g): the augmented Lagrangian.
/// Without a penalty (ρ = 0) it is −Σ λ g: a constraint holds the gap, and only the rotation of the
/// force's direction (−λ ∇²g) enters the tangent.
class PlateTerm final : public Term {
 public:
  explicit PlateTerm(std::vector<int> candidates);

  /// Sets the position of the plates.
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
