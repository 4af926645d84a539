// SPDX-License-Identifier: GPL-3.0-or-later
// The derivative ∂R/∂m of an equilibrium's residual with respect to a parameter at a fixed shape.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mechanics/scene.hpp"
#include "sensitivity/parameter.hpp"

namespace breast {

/// A state of one breast and the gravity (mm/s²) that acts on it.
struct LoadedState {
  State state;
  Vec3 gravity{0, 0, 0};
};

/// One column per parameter; the columns of the other state's gravity and of the plates are zero.
struct ParameterForces {
  Eigen::MatrixXd force;   ///< ∂r/∂m, µN per unit of the parameter (3 per node)
  Eigen::MatrixXd volume;  ///< ∂θ/∂m, mm³ (with a finite bulk modulus only)
};

/// `role` is the gravity of the state: ParameterKind::gravity or imaged_gravity.
ParameterForces parameter_forces(const Scene& scene, const LoadedState& state, ParameterKind role,
                                 const std::vector<Parameter>& parameters);

/// λᵀ ∂r/∂(ln stiffness of element e) for every element, with the skin's faces assigned to their
/// element; λ is a nodal field (mm).
std::vector<double> element_stiffness_products(const Scene& scene, const LoadedState& state,
                                               const Eigen::VectorXd& lambda);

}  // namespace breast
