// SPDX-License-Identifier: GPL-3.0-or-later
// A configuration of a body and its forces, as exchanged by all solvers.
#pragma once

#include <Eigen/Core>

namespace breast {

/// Stress-free positions X and deformed positions x (3 per node, mm), pressures p (Pa, rows per
/// element). Forward problems and contact seek x and p, the inverse problem X and p.
struct State {
  Eigen::VectorXd reference, x, p;
};

/// Energy and its derivatives at a state, summed over terms: r = ∂Π/∂x (µN), θ = −∂Π/∂p (mm³).
struct Forces {
  bool valid = false;    ///< false: a folded element or a law out of range; nothing else is set
  int bad_element = -1;  ///< the first invalid element, if it is known; otherwise −1
  double energy = 0;     ///< nJ
  Eigen::VectorXd r, theta;
  /// Gradient of the augmented energy, r + κBᵀM⁻¹θ; only if requested with a κ.
  Eigen::VectorXd augmented;
  double min_det_F = 1, max_det_F = 1, max_volume_error = 0;
};

}  // namespace breast
