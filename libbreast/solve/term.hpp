// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of a term, one contribution to the energy of a body: its solid, skin, a load, a support
// or a plate. A problem is a list of terms (solve/problem.hpp); what a scene lacks is not in the
// list and costs nothing.
#pragma once

#include <string>
#include <vector>

#include "solve/packed_tangent.hpp"
#include "solve/reference_tangent.hpp"
#include "solve/saddle_matrix.hpp"
#include "solve/state.hpp"

namespace breast {

/// Quantities that one pass over the terms computes besides energy, r and θ; null means not
/// requested.
struct Request {
  const Eigen::VectorXd* kappa = nullptr;  ///< fills Forces::augmented
  SaddleMatrix* matrix = nullptr;          ///< the tangent, assembled
  PackedTangent* packed = nullptr;         ///< K + κBᵀM⁻¹B, by cells
  double augmentation = 0;  ///< κ/μ of the tangent; 0: what suits the linear solver
  ReferenceTangent* reference = nullptr;
};

class Term {
 public:
  virtual ~Term() = default;

  /// For reports and tests.
  virtual std::string name() const = 0;
  /// Adds the energy, r and θ of this term, and the requested quantities. Returns false at an
  /// inadmissible state, where the contents of `forces` and of the request's targets are undefined.
  virtual bool add(const State& state, const Request& request, Forces& forces) const = 0;
  /// The nodes whose positions it depends on and whose forces it changes, ascending.
  virtual std::vector<int> nodes() const = 0;
  /// An element that is not positive in both shapes at its nodes and quadrature points; −1 if
  /// there is none, as for terms without elements.
  virtual int folded_element(const State&) const { return -1; }
};

}  // namespace breast
