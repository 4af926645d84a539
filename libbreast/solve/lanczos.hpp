// The upper end of a symmetric map's spectrum by Lanczos' method.
#pragma once

#include <Eigen/Core>

#include "solve/gmres.hpp"

namespace breast {

/// Bound that the largest eigenvalue of a symmetric map is not expected to exceed: the largest Ritz
/// value after `steps` products from `start` (not zero), plus its residual. Not finite where the
/// map is not. Unlike as many power iterations it is not misled by a start that hardly contains the
/// eigenvector (Saad 2011, "Numerical methods for large eigenvalue problems", section 6.3).
double largest_eigenvalue(const LinearMap& a, const Eigen::VectorXd& start, int steps);

}  // namespace breast
