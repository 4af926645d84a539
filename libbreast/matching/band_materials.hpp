// SPDX-License-Identifier: GPL-3.0-or-later
// Contribution of a material set's own covariance to the band of cc2mlo.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "matching/band.hpp"

namespace breast {

/// Replaces the priors of the parameters of a set by its covariance of logarithms: stiffness of fat
/// (low_order, quadratic, stiffness), fibroglandular tissue (gland), skin, wall and cut. Correlated
/// parameters become independent causes: for each eigenvector of the covariance, the fields get the
/// corresponding combination of derivatives and `priors` its standard deviation, under the names
/// "materials_1" and so on, the widest first. Throws Error (input) if a file lacks a derivative.
void use_covariance(const std::vector<std::string>& parameters, const Eigen::MatrixXd& covariance,
                    DerivativeFields& from, DerivativeFields& to, std::vector<Prior>& priors);

}  // namespace breast
