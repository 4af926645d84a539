// SPDX-License-Identifier: GPL-3.0-or-later
// The prior of a patient's material parameters.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "material/material_set.hpp"

namespace breast {

enum class PriorKind { set, none };
/// "set" or "none". Throws Error (input) for any other name.
PriorKind prior_from_name(const std::string& name);

/// Covariance of the logarithms of factors on the named parts of a set
/// (material/set_parameter.hpp), with the set itself as the mean. It is the set's own uncertainty
/// if it has one; otherwise the standard deviation is 1.1 (a factor of three either way), and 0.7
/// for the ratio of gland to fat. With `none` it is a factor of twenty either way for each, which
/// only keeps undetermined parameters finite.
Eigen::MatrixXd prior_covariance(const MaterialSet& set, const std::vector<std::string>& names,
                                 PriorKind kind);

}  // namespace breast
