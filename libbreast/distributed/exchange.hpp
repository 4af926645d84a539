// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the ranks that share a body, each of which has a MeshPart.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "distributed/mesh_part.hpp"
#include "solve/sharing.hpp"

namespace breast {

class Exchange final : public Sharing {
 public:
  /// Both must outlive this object.
  Exchange(const Ranks& ranks, const MeshPart& part);
  const Ranks& ranks() const { return ranks_; }
  const MeshPart& part() const { return part_; }

  double sum(double mine) const override { return ranks_.sum(mine); }
  double most(double mine) const override { return ranks_.most(mine); }
  bool all(bool mine) const override { return ranks_.all(mine); }
  int first_element(int mine) const override;
  /// All ranks add in the same order, so that they get identical bits. `values` has the same number
  /// of entries for every node.
  void complete(Eigen::VectorXd& values) const override;
  double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const override;
  /// Sends the owner's values of a node to every other rank that has it.
  void from_owner(Eigen::VectorXd& values) const;

 private:
  const Ranks& ranks_;
  const MeshPart& part_;
  std::vector<int> all_;  // nodes of this part that other ranks have too
};

}  // namespace breast
