// SPDX-License-Identifier: GPL-3.0-or-later
// The smoothing energy of a hexahedral mesh and its gradient, sample by sample.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace breast {

class CornerEnergy {
 public:
  struct Parameters {
    double theta = 0.2;  ///< weight of size against shape
    int power = 8;
    double epsilon = 1e-6;   ///< regularisation of det A near and below 0
    bool mid_edges = false;  ///< also sample at the 12 mid-edges, which flat corners (180°) need
  };
  /// `connectivity` has 8 nodes per element in VTK order. The target edge is that of the mean
  /// element of `x`.
  CornerEnergy(const std::vector<int>& connectivity, const std::vector<Vec3>& x);

  void set(const Parameters& parameters) { parameters_ = parameters; }
  double edge() const { return edge_; }  ///< mm
  /// Sum over samples, with the gradient per node (1/mm). Independent of the number of threads.
  double evaluate(const std::vector<Vec3>& x, std::vector<Vec3>& gradient);
  /// Smallest determinant over the samples, relative to edge³.
  double min_det(const std::vector<Vec3>& x) const;

 private:
  double element(const std::vector<Vec3>& x, int e, Vec3* force) const;

  const std::vector<int>& connectivity_;
  Parameters parameters_;
  double edge_ = 1;
  std::vector<int> first_, uses_;  ///< positions of every node in the connectivity
  std::vector<Vec3> forces_;       ///< one per position in the connectivity
  std::vector<double> energies_;   ///< per element
};

}  // namespace breast
