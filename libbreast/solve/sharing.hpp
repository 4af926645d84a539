// SPDX-License-Identifier: GPL-3.0-or-later
// What several processes that solve one body together must sum or agree on. Each has the terms of its
// own elements and all their nodes; a body in one piece has no Sharing (solve/problem.hpp).
#pragma once

#include <Eigen/Core>

namespace breast {

/// Every function is collective, and its result is the same in all processes to the last bit.
class Sharing {
 public:
  virtual ~Sharing() = default;
  virtual double sum(double mine) const = 0;
  virtual double most(double mine) const = 0;
  virtual bool all(bool mine) const = 0;
  /// The first of the elements that the processes name, in the numbering of the whole body; −1 names
  /// none.
  virtual int first_element(int mine) const = 0;
  /// Replaces this process's values at a node by the sum over all processes that have the node.
  virtual void complete(Eigen::VectorXd& nodal) const = 0;
  /// Sum of a · b over the nodes of the body, of complete values (3 per node).
  virtual double dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const = 0;
};

}  // namespace breast
